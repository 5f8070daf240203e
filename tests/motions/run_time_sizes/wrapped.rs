//! A mechanism whose numbers of coordinates, names and groups are known while the program runs only: one of the gallery, behind
//! types that hold numbers.

use std::fmt::Debug;

use linkage::kinematic::{
    FullKinematics, FullKinematicsOf, Kinematics, KinematicsOf, Motion, MotionOf, Quantity, Ratios,
};
use linkage::nalgebra::{Point2, Vector2};
use linkage::{
    Assembly, Bounded, Branches, Build, Column, D, Dim, Group, InputValues, Kinematic, Matrix, Mechanism,
    PositionError, Ranged, UpTo,
};

/// More unknowns, groups, points and outputs than any mechanism here has.
pub type Most = UpTo<24>;
/// All coordinates.
type All = UpTo<25>;
type Numbers = Column<f64, Most>;
type Input = Column<f64, D<1>>;
pub type List<X> = <Most as Dim>::Array<X>;

/// The names and the groups of a mechanism, as texts that belong to no type.
pub struct Texts {
    name: String,
    unknowns: Vec<String>,
    inputs: Vec<String>,
    groups: Vec<String>,
    ranges: Vec<String>,
}

impl Texts {
    /// Those of a mechanism, each with this mark.
    pub fn marked_by<M: Mechanism>(mark: &str) -> Self {
        let marked = |names: &[&str]| names.iter().map(|name| format!("{name}{mark}")).collect();
        let groups: Vec<&str> = M::GROUPS.iter().map(|group| group.name).collect();
        Self {
            name: format!("{}{mark}", M::NAME),
            unknowns: marked(M::UNKNOWNS),
            inputs: marked(M::INPUTS),
            groups: marked(&groups),
            ranges: marked(M::RANGES),
        }
    }

    /// The names of the inputs.
    pub fn inputs(&self) -> Vec<&str> {
        self.inputs.iter().map(String::as_str).collect()
    }

    /// The groups with these names.
    pub fn groups<M: Mechanism>(&self) -> Vec<Group<'_, &str>> {
        let pairs = self.groups.iter().zip(M::GROUPS);
        pairs.map(|(name, of)| Group { name: name.as_str(), equations: of.equations, unknowns: of.unknowns }).collect()
    }
}

/// A mechanism of the gallery at run time.
#[derive(Clone, Copy)]
pub struct AtRunTime<'n, M> {
    pub of: M,
    pub texts: &'n Texts,
    pub inputs: &'n [&'n str],
    pub groups: &'n [Group<'n, &'n str>],
}

/// Coordinates, rates or accelerations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Split {
    unknowns: Numbers,
    input: Input,
}

impl From<Bounded<f64, 25>> for Split {
    fn from(list: Bounded<f64, 25>) -> Self {
        let (input, unknowns) = list.as_ref().split_last().expect("an input");
        Self { unknowns: Column::from_slice(unknowns).expect("few unknowns"), input: [*input].into() }
    }
}

impl From<Split> for Bounded<f64, 25> {
    fn from(Split { unknowns, input }: Split) -> Self {
        let all: Vec<f64> = unknowns.iter().chain(&input).copied().collect();
        All::new(all.len()).expect("few coordinates").array(|place| all[place])
    }
}

/// A column of the same numbers in another type.
pub fn column<X: Copy + Debug, R: Dim, S: Dim>(of: &Column<X, R>) -> Column<X, S> {
    Column::from_slice(of.as_slice()).expect("a number that both types have")
}

fn matrix<R: Dim, C: Dim, S: Dim, K: Dim>(of: &Matrix<f64, R, C>, rows: S, columns: K) -> Matrix<f64, S, K> {
    rows.matrix(columns, |row, column| of[(row, column)])
}

/// A list of the same quantities in another type.
fn list<X: Quantity>(of: &[X]) -> List<X> {
    Most::new(of.len()).expect("few quantities").array(|place| of[place])
}

impl<'n, M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>> AtRunTime<'n, M> {
    /// The name at run time of one of the type; names of the library stay.
    pub fn own(&self, name: &'static str) -> &'n str {
        let texts = self.texts;
        let known = M::UNKNOWNS.iter().chain(M::INPUTS).chain(M::RANGES).copied();
        let known = known.chain(M::GROUPS.iter().map(|group| group.name)).chain([M::NAME]);
        let own = texts.unknowns.iter().chain(&texts.inputs).chain(&texts.ranges).chain(&texts.groups);
        let mut pairs = known.zip(own.chain([&texts.name]));
        pairs.find(|(known, _)| *known == name).map_or(name, |(_, own)| own)
    }

    fn named<X>(&self, found: Result<X, PositionError>) -> Result<X, PositionError<&'n str>> {
        let mechanism = self.texts.name.as_str();
        found.map_err(|error| match error {
            PositionError::Singular { group, regularity, .. } => {
                PositionError::Singular { mechanism, group: self.own(group), regularity }
            }
            PositionError::Undetermined { group, .. } => {
                PositionError::Undetermined { mechanism, group: self.own(group) }
            }
            PositionError::NotFinite { quantity, .. } => {
                PositionError::NotFinite { mechanism, quantity: self.own(quantity) }
            }
            PositionError::Unbuildable { group, gap, inputs, .. } => {
                let value = inputs.iter().next().map_or(0.0, |(_, value)| value);
                let inputs = InputValues::new(self.inputs, self.of.input_angles(), [value, 0.0, 0.0]);
                PositionError::Unbuildable { mechanism, group: self.own(group), gap, inputs }
            }
            PositionError::NotImplied { equation, residual, .. } => {
                PositionError::NotImplied { mechanism, equation: self.own(equation), residual }
            }
            other => panic!("{other}"),
        })
    }

    pub fn split(q: &M::Coordinates) -> Split {
        let (unknowns, input) = M::parts(q);
        Split { unknowns: column(&unknowns), input }
    }

    fn coordinates_in(q: &Split) -> M::Coordinates {
        M::coordinates(column(&q.unknowns), q.input)
    }

    fn rates_in(rates: &Split) -> M::Rates {
        M::rates(column(&rates.unknowns), rates.input)
    }

    fn split_rates(rates: &M::Rates) -> Split {
        let (unknowns, input) = M::rate_parts(rates);
        Split { unknowns: column(&unknowns), input }
    }

    fn split_accelerations(accelerations: &M::Accelerations) -> Split {
        let (unknowns, input) = M::acceleration_parts(accelerations);
        Split { unknowns: column(&unknowns), input }
    }
}

impl<'n, M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>> Mechanism for AtRunTime<'n, M> {
    type Scalar = f64;
    type Name = &'n str;
    type U = Most;
    type V = D<1>;
    type G = Most;
    type Coordinates = Split;
    type Rates = Split;
    type Inputs = Input;
    type Pose = M::Pose;
    type Branch = M::Branch;

    // A constant of a mechanism at run time that an algorithm reads does not compile.
    const NAME: &'static str = panic!("a name of a value");
    const UNKNOWNS: &'static [&'static str] = panic!("names of a value");
    const INPUTS: &'static [&'static str] = panic!("names of a value");
    const UNKNOWN_ANGLES: &'static [bool] = panic!("angles of a value");
    const INPUT_ANGLES: &'static [bool] = panic!("angles of a value");
    const GROUPS: &'static [Group<'static>] = panic!("groups of a value");
    const RANGES: &'static [&'static str] = panic!("ranges of a value");

    fn name(&self) -> &'n str {
        &self.texts.name
    }
    fn unknown_name(&self, place: usize) -> &'n str {
        self.texts.unknowns.get(place).map_or("", String::as_str)
    }
    fn input_name(&self, place: usize) -> &'n str {
        self.texts.inputs.get(place).map_or("", String::as_str)
    }
    fn unknown_angles(&self) -> &[bool] {
        self.of.unknown_angles()
    }
    fn input_angles(&self) -> &[bool] {
        self.of.input_angles()
    }
    fn group(&self, place: usize) -> Option<Group<'_, &'n str>> {
        self.groups.get(place).copied()
    }
    fn group_list(&self) -> &'n [Group<'n, &'n str>] {
        self.groups
    }
    fn range_name(&self, place: usize) -> Option<&'n str> {
        self.texts.ranges.get(place).map(String::as_str)
    }
    fn dims(&self) -> (Most, D<1>, Most) {
        let (u, v, g) = self.of.dims();
        let most = |count| Most::new(count).expect("few unknowns");
        (most(u.count()), v, most(g.count()))
    }
    fn coordinates(unknowns: Numbers, input: Input) -> Split {
        Split { unknowns, input }
    }
    fn parts(q: &Split) -> (Numbers, Input) {
        (q.unknowns, q.input)
    }
    fn rates(unknowns: Numbers, input: Input) -> Split {
        Split { unknowns, input }
    }
    fn rate_parts(rates: &Split) -> (Numbers, Input) {
        (rates.unknowns, rates.input)
    }
    fn pose_at(&self, q: &Split) -> M::Pose {
        self.of.pose_at(&Self::coordinates_in(q))
    }
    fn is_finite(pose: &M::Pose) -> bool {
        M::is_finite(pose)
    }
    fn branch_of(&self, pose: &M::Pose) -> M::Branch {
        self.of.branch_of(pose)
    }
    fn residual(&self, pose: &M::Pose) -> Numbers {
        column(&self.of.residual(pose))
    }
    fn residual_scales(&self, pose: &M::Pose) -> Numbers {
        column(&self.of.residual_scales(pose))
    }
    fn jacobian_unknowns(&self, pose: &M::Pose) -> Matrix<f64, Most, Most> {
        let (u, ..) = self.dims();
        matrix(&self.of.jacobian_unknowns(pose), u, u)
    }
    fn jacobian_inputs(&self, pose: &M::Pose) -> Matrix<f64, Most, D<1>> {
        matrix(&self.of.jacobian_inputs(pose), self.dims().0, D)
    }
    fn jacobian_unknowns_scales(&self, pose: &M::Pose) -> Matrix<f64, Most, Most> {
        let (u, ..) = self.dims();
        matrix(&self.of.jacobian_unknowns_scales(pose), u, u)
    }
    fn jacobian_inputs_scales(&self, pose: &M::Pose) -> Matrix<f64, Most, D<1>> {
        matrix(&self.of.jacobian_inputs_scales(pose), self.dims().0, D)
    }
    fn determinant(&self, pose: &M::Pose) -> f64 {
        self.of.determinant(pose)
    }
    fn block_determinants(&self, pose: &M::Pose) -> Numbers {
        column(&self.of.block_determinants(pose))
    }
    fn gamma(&self, pose: &M::Pose, rates: &Split) -> Numbers {
        column(&self.of.gamma(pose, &Self::rates_in(rates)))
    }
    fn solve_jacobian(&self, pose: &M::Pose, right: &Numbers) -> Result<Numbers, PositionError<&'n str>> {
        self.named(self.of.solve_jacobian(pose, &column(right))).map(|solution| column(&solution))
    }
    fn length_scale(&self, pose: &M::Pose) -> f64 {
        self.of.length_scale(pose)
    }
    fn check_implied(&self, q: &Split) -> Result<(), PositionError<&'n str>> {
        self.named(self.of.check_implied(&Self::coordinates_in(q)))
    }
    fn ranged(&self, place: usize, q: &Split) -> Option<Ranged<f64>> {
        self.of.ranged(place, &Self::coordinates_in(q))
    }
}

impl<'n, M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>>> Kinematic for AtRunTime<'n, M> {
    type N = All;
    type P = Most;
    type O = Most;
    type Accelerations = Split;
    type Points<Q: Quantity> = List<Q>;
    type Outputs<Q: Quantity> = List<Q>;

    const POINTS: &'static [&'static str] = panic!("names of a value");
    const OUTPUTS: &'static [&'static str] = panic!("names of a value");

    fn point_name(&self, place: usize) -> &'n str {
        self.of.point_name(place)
    }
    fn output_name(&self, place: usize) -> &'n str {
        self.of.output_name(place)
    }

    fn coordinates_of(pose: &M::Pose) -> Split {
        Self::split(&M::coordinates_of(pose))
    }
    fn velocity(&self, pose: &M::Pose, input_rates: Input) -> Result<Split, PositionError<&'n str>> {
        self.named(self.of.velocity(pose, input_rates.into())).map(|rates| Self::split_rates(&rates))
    }
    fn acceleration(
        &self,
        pose: &M::Pose,
        rates: &Split,
        input_accelerations: Input,
    ) -> Result<Split, PositionError<&'n str>> {
        let found = self.of.acceleration(pose, &Self::rates_in(rates), input_accelerations.into());
        self.named(found).map(|accelerations| Self::split_accelerations(&accelerations))
    }
    fn kinematics(
        &self,
        guess: &Split,
        branch: M::Branch,
        input_rates: Input,
        input_accelerations: Input,
    ) -> Result<KinematicsOf<Self>, PositionError<&'n str>> {
        let guess = Self::coordinates_in(guess);
        let found = self.of.kinematics(&guess, branch, input_rates.into(), input_accelerations.into());
        let Kinematics { pose, rates, accelerations } = self.named(found)?;
        let accelerations = Self::split_accelerations(&accelerations);
        Ok(Kinematics { pose, rates: Self::split_rates(&rates), accelerations })
    }
    fn full_kinematics(
        &self,
        guess: &Split,
        branch: M::Branch,
        input_rates: Input,
        input_accelerations: Input,
    ) -> Result<FullKinematicsOf<Self>, PositionError<&'n str>> {
        let guess = Self::coordinates_in(guess);
        let found = self.of.full_kinematics(&guess, branch, input_rates.into(), input_accelerations.into());
        let FullKinematics { pose, rates, accelerations, points, outputs } = self.named(found)?;
        Ok(FullKinematics {
            pose,
            rates: Self::split_rates(&rates),
            accelerations: Self::split_accelerations(&accelerations),
            points: list(M::each_point(points).as_slice()),
            outputs: list(M::each_output(outputs).as_slice()),
        })
    }
    fn motion(
        &self,
        q: &Split,
        input_rates: Input,
        input_accelerations: Input,
    ) -> Result<MotionOf<Self>, PositionError<&'n str>> {
        let found = self.of.motion(&Self::coordinates_in(q), input_rates.into(), input_accelerations.into());
        let Motion { position, rates, accelerations, points, outputs } = self.named(found)?;
        Ok(Motion {
            position: Self::split(&position),
            rates: Self::split_rates(&rates),
            accelerations: Self::split_accelerations(&accelerations),
            points: list(M::each_point(points).as_slice()),
            outputs: list(M::each_output(outputs).as_slice()),
        })
    }
    fn velocity_ratios(&self, pose: &M::Pose) -> Result<Ratios<Self, Most>, PositionError<&'n str>> {
        self.named(self.of.velocity_ratios(pose)).map(|ratios| matrix(&ratios, self.dims().0, D))
    }
    fn points(&self, pose: &M::Pose) -> Result<List<Point2<f64>>, PositionError<&'n str>> {
        self.named(self.of.points(pose)).map(|points| list(M::each_point(points).as_slice()))
    }
    fn point_velocities(&self, pose: &M::Pose, rates: &Split) -> Result<List<Vector2<f64>>, PositionError<&'n str>> {
        let found = self.of.point_velocities(pose, &Self::rates_in(rates));
        self.named(found).map(|points| list(M::each_point(points).as_slice()))
    }
    fn point_accelerations(
        &self,
        pose: &M::Pose,
        rates: &Split,
        accelerations: &Split,
    ) -> Result<List<Vector2<f64>>, PositionError<&'n str>> {
        let accelerations = M::accelerations(column(&accelerations.unknowns), accelerations.input);
        let found = self.of.point_accelerations(pose, &Self::rates_in(rates), &accelerations);
        self.named(found).map(|points| list(M::each_point(points).as_slice()))
    }
    fn point_ratios(&self, pose: &M::Pose) -> Result<List<Ratios<Self, D<2>>>, PositionError<&'n str>> {
        let found = self.named(self.of.point_ratios(pose))?;
        Ok(list(M::each_point(found).map(|ratios| matrix(&ratios, D, D)).as_slice()))
    }
    fn output_ratios(&self, pose: &M::Pose) -> Result<List<Ratios<Self, D<1>>>, PositionError<&'n str>> {
        let found = self.named(self.of.output_ratios(pose))?;
        Ok(list(M::each_output(found).map(|ratios| matrix(&ratios, D, D)).as_slice()))
    }
    fn outputs(&self, pose: &M::Pose) -> Result<List<f64>, PositionError<&'n str>> {
        self.named(self.of.outputs(pose)).map(|outputs| list(M::each_output(outputs).as_slice()))
    }
    fn output_rates(&self, pose: &M::Pose, rates: &Split) -> Result<List<f64>, PositionError<&'n str>> {
        let found = self.of.output_rates(pose, &Self::rates_in(rates));
        self.named(found).map(|outputs| list(M::each_output(outputs).as_slice()))
    }
    fn output_accelerations(
        &self,
        pose: &M::Pose,
        rates: &Split,
        accelerations: &Split,
    ) -> Result<List<f64>, PositionError<&'n str>> {
        let accelerations = M::accelerations(column(&accelerations.unknowns), accelerations.input);
        let found = self.of.output_accelerations(pose, &Self::rates_in(rates), &accelerations);
        self.named(found).map(|outputs| list(M::each_output(outputs).as_slice()))
    }
}

impl<'n, M> Branches for AtRunTime<'n, M>
where
    M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>> + Branches,
{
    fn all_positions(&self, inputs: Input) -> Result<impl Iterator<Item = (M::Branch, Split)>, PositionError<&'n str>> {
        let all = self.named(self.of.all_positions(inputs.into()))?;
        Ok(all.map(|(branch, q)| (branch, Self::split(&q))))
    }
}

impl<'n, M> Assembly for AtRunTime<'n, M>
where
    M: Kinematic<Scalar = f64, Name = &'static str, V = D<1>> + Assembly,
{
    fn assemble(&self, inputs: Input, branch: M::Branch) -> Result<M::Pose, PositionError<&'n str>> {
        self.named(self.of.assemble(inputs.into(), branch))
    }
}
