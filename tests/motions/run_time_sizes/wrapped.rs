//! A mechanism whose numbers of coordinates, names and groups are known while the program runs only: one of the gallery, behind
//! types that hold numbers.

use std::fmt::Debug;

use linkage::{Branches, Build, Column, D, Dim, Group, InputValues, Matrix, Mechanism, PositionError, Ranged, UpTo};

/// More unknowns, groups, points and outputs than any mechanism here has.
pub type Most = UpTo<24>;
type Numbers = Column<f64, Most>;
type Input = Column<f64, D<1>>;

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

/// A column of the same numbers in another type.
pub fn column<X: Copy + Debug, R: Dim, S: Dim>(of: &Column<X, R>) -> Column<X, S> {
    Column::from_slice(of.as_slice()).expect("a number that both types have")
}

fn matrix<R: Dim, C: Dim, S: Dim, K: Dim>(of: &Matrix<f64, R, C>, rows: S, columns: K) -> Matrix<f64, S, K> {
    rows.matrix(columns, |row, column| of[(row, column)])
}

impl<'n, M: Mechanism<Scalar = f64, Name = &'static str, V = D<1>>> AtRunTime<'n, M> {
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
}

impl<'n, M: Mechanism<Scalar = f64, Name = &'static str, V = D<1>>> Mechanism for AtRunTime<'n, M> {
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

impl<'n, M> Branches for AtRunTime<'n, M>
where
    M: Mechanism<Scalar = f64, Name = &'static str, V = D<1>> + Branches,
{
    fn all_positions(&self, inputs: Input) -> Result<impl Iterator<Item = (M::Branch, Split)>, PositionError<&'n str>> {
        let all = self.named(self.of.all_positions(inputs.into()))?;
        Ok(all.map(|(branch, q)| (branch, Self::split(&q))))
    }
}
