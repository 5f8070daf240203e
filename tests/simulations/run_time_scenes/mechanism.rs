//! A mechanism whose numbers of coordinates and names are known while the program runs only: one that is emitted, behind types
//! that hold numbers.

use linkage::{Build, Column, Dim, Group, InputError, Matrix, Mechanism, PositionError, Ranged, Scene, UpTo};

/// More unknowns, inputs and groups than any mechanism here has.
pub type Unknowns = UpTo<5>;
pub type Inputs = UpTo<4>;
pub type Groups = UpTo<6>;

/// The names of a scene and of its mechanism, as texts that belong to no type, each with the one that it marks.
pub struct Texts(Vec<(&'static str, String)>);

impl Texts {
    /// Those of a scene with these frictions and stops, marked.
    pub fn of<S: Scene>(contacts: &[&'static str]) -> Self {
        let groups = <S::Mechanism as Mechanism>::GROUPS.iter().map(|group| group.name);
        let kinks = S::KINKS.iter().map(|kink| kink.effect);
        let names = [S::NAME, S::Mechanism::NAME].into_iter().chain(groups).chain(kinks);
        let names = names.chain(S::Mechanism::UNKNOWNS.iter().chain(S::Mechanism::INPUTS).copied());
        let names = names.chain(S::Mechanism::RANGES.iter().copied()).chain(contacts.iter().copied());
        Self(names.map(|name| (name, format!("{name} at run time"))).collect())
    }

    /// The name at run time of one of the type; names of the library stay.
    pub fn own(&self, name: &'static str) -> &str {
        self.0.iter().find(|(known, _)| *known == name).map_or(name, |(_, own)| own)
    }

    /// The groups with these names.
    pub fn groups<M: Mechanism>(&self) -> Vec<Group<'_, &str>> {
        let own =
            |of: &Group<'static>| Group { name: self.own(of.name), equations: of.equations, unknowns: of.unknowns };
        M::GROUPS.iter().map(own).collect()
    }

    pub fn position_error(&self, error: PositionError) -> PositionError<&str> {
        match error {
            PositionError::Singular { mechanism, group, regularity } => {
                PositionError::Singular { mechanism: self.own(mechanism), group: self.own(group), regularity }
            }
            PositionError::NotFinite { mechanism, quantity } => {
                PositionError::NotFinite { mechanism: self.own(mechanism), quantity: self.own(quantity) }
            }
            PositionError::Input(error) => PositionError::Input(self.input_error(error)),
            other => panic!("{other}"),
        }
    }

    pub fn input_error(&self, error: InputError) -> InputError<&str> {
        error.map_names(|name| self.own(name))
    }
}

/// An emitted mechanism at run time.
#[derive(Clone, Copy)]
pub struct MechanismAtRunTime<'n, M> {
    pub of: &'n M,
    pub texts: &'n Texts,
    pub groups: &'n [Group<'n, &'n str>],
}

/// Coordinates or rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Split {
    pub unknowns: Column<f64, Unknowns>,
    pub inputs: Column<f64, Inputs>,
}

/// A column of the same entries in another type.
pub fn column<X: Copy + std::fmt::Debug, R: Dim, S: Dim>(of: &Column<X, R>) -> Column<X, S> {
    Column::from_slice(of.as_slice()).expect("a number that both types have")
}

pub fn matrix<R: Dim, C: Dim, S: Dim, K: Dim>(of: &Matrix<f64, R, C>) -> Matrix<f64, S, K> {
    let (rows, columns) = of.dims();
    let (rows, columns) = (S::new(rows.count()).expect("few rows"), K::new(columns.count()).expect("few columns"));
    rows.matrix(columns, |row, column| of[(row, column)])
}

impl Split {
    pub fn of<M: Mechanism<Scalar = f64>>(q: &M::Coordinates) -> Self {
        let (unknowns, inputs) = M::parts(q);
        Self { unknowns: column(&unknowns), inputs: column(&inputs) }
    }

    pub fn coordinates<M: Mechanism<Scalar = f64>>(&self) -> M::Coordinates {
        M::coordinates(column(&self.unknowns), column(&self.inputs))
    }

    pub fn rates<M: Mechanism<Scalar = f64>>(&self) -> M::Rates {
        M::rates(column(&self.unknowns), column(&self.inputs))
    }
}

impl<'n, M: Mechanism<Scalar = f64, Name = &'static str>> Mechanism for MechanismAtRunTime<'n, M> {
    type Scalar = f64;
    type Name = &'n str;
    type U = Unknowns;
    type V = Inputs;
    type G = Groups;
    type Coordinates = Split;
    type Rates = Split;
    type Inputs = Column<f64, Inputs>;
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
        self.texts.own(M::NAME)
    }
    fn unknown_name(&self, place: usize) -> &'n str {
        M::UNKNOWNS.get(place).map_or("", |name| self.texts.own(name))
    }
    fn input_name(&self, place: usize) -> &'n str {
        M::INPUTS.get(place).map_or("", |name| self.texts.own(name))
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
        M::RANGES.get(place).map(|name| self.texts.own(name))
    }
    fn dims(&self) -> (Unknowns, Inputs, Groups) {
        fn few<N: Dim>(count: usize) -> N {
            N::new(count).expect("few coordinates")
        }
        let (u, v, g) = self.of.dims();
        (few(u.count()), few(v.count()), few(g.count()))
    }
    fn coordinates(unknowns: Column<f64, Unknowns>, inputs: Column<f64, Inputs>) -> Split {
        Split { unknowns, inputs }
    }
    fn parts(q: &Split) -> (Column<f64, Unknowns>, Column<f64, Inputs>) {
        (q.unknowns, q.inputs)
    }
    fn rates(unknowns: Column<f64, Unknowns>, inputs: Column<f64, Inputs>) -> Split {
        Split { unknowns, inputs }
    }
    fn rate_parts(rates: &Split) -> (Column<f64, Unknowns>, Column<f64, Inputs>) {
        (rates.unknowns, rates.inputs)
    }
    fn pose_at(&self, q: &Split) -> M::Pose {
        self.of.pose_at(&q.coordinates::<M>())
    }
    fn is_finite(pose: &M::Pose) -> bool {
        M::is_finite(pose)
    }
    fn branch_of(&self, pose: &M::Pose) -> M::Branch {
        self.of.branch_of(pose)
    }
    fn residual(&self, pose: &M::Pose) -> Column<f64, Unknowns> {
        column(&self.of.residual(pose))
    }
    fn residual_scales(&self, pose: &M::Pose) -> Column<f64, Unknowns> {
        column(&self.of.residual_scales(pose))
    }
    fn jacobian_unknowns(&self, pose: &M::Pose) -> Matrix<f64, Unknowns, Unknowns> {
        matrix(&self.of.jacobian_unknowns(pose))
    }
    fn jacobian_inputs(&self, pose: &M::Pose) -> Matrix<f64, Unknowns, Inputs> {
        matrix(&self.of.jacobian_inputs(pose))
    }
    fn jacobian_unknowns_scales(&self, pose: &M::Pose) -> Matrix<f64, Unknowns, Unknowns> {
        matrix(&self.of.jacobian_unknowns_scales(pose))
    }
    fn jacobian_inputs_scales(&self, pose: &M::Pose) -> Matrix<f64, Unknowns, Inputs> {
        matrix(&self.of.jacobian_inputs_scales(pose))
    }
    fn determinant(&self, pose: &M::Pose) -> f64 {
        self.of.determinant(pose)
    }
    fn block_determinants(&self, pose: &M::Pose) -> Column<f64, Groups> {
        column(&self.of.block_determinants(pose))
    }
    fn gamma(&self, pose: &M::Pose, rates: &Split) -> Column<f64, Unknowns> {
        column(&self.of.gamma(pose, &rates.rates::<M>()))
    }
    fn solve_jacobian(
        &self,
        pose: &M::Pose,
        right: &Column<f64, Unknowns>,
    ) -> Result<Column<f64, Unknowns>, PositionError<&'n str>> {
        let solution = self.of.solve_jacobian(pose, &column(right));
        solution.map(|solution| column(&solution)).map_err(|error| self.texts.position_error(error))
    }
    fn length_scale(&self, pose: &M::Pose) -> f64 {
        self.of.length_scale(pose)
    }
    fn check_implied(&self, q: &Split) -> Result<(), PositionError<&'n str>> {
        self.of.check_implied(&q.coordinates::<M>()).map_err(|error| self.texts.position_error(error))
    }
    fn ranged(&self, place: usize, q: &Split) -> Option<Ranged<f64>> {
        self.of.ranged(place, &q.coordinates::<M>())
    }
}
