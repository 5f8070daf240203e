//! A scene whose numbers and names are known while the program runs only: one that is emitted, behind types that hold numbers.

use linkage::{
    Accelerations, Bearing, Bounded, Build, Column, Contact, ContactCoordinate, Dim, Energy, Equations, Joint,
    JointForces, Kink, Mechanism, MotionError, Prescribed, ReactionRow, Scene, StateParts, Unreduced, UpTo,
};

use super::mechanism::{Inputs, MechanismAtRunTime, Split, Texts, Unknowns, column, matrix};

/// More components and contacts than any scene here has.
type State = Column<f64, UpTo<13>>;
type Contacts = UpTo<5>;
type MostJoints = UpTo<8>;
type Fallible<'n, X> = Result<X, MotionError<&'n str>>;
type BearingHere = Bearing<f64, Unknowns, Inputs, Contacts>;

/// The joints of a scene.
pub type Joints<'n> = Vec<Joint<&'n str>>;

/// An emitted scene at run time.
#[derive(Clone, Copy)]
pub struct SceneAtRunTime<'n, S: Scene> {
    pub of: &'n S,
    pub texts: &'n Texts,
    pub joints: &'n [Joint<&'n str>],
    pub contacts: usize,
    pub mechanism: MechanismAtRunTime<'n, S::Mechanism>,
}

/// The forces in the joints of a scene at run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forces<'n> {
    joints: &'n [Joint<&'n str>],
    forces: Bounded<[f64; 2], 8>,
}

impl<'n> JointForces<f64, &'n str> for Forces<'n> {
    type Mechanism = ();

    const JOINTS: &'static [Joint] = panic!("joints of a value");

    fn joints(&self) -> impl Iterator<Item = Joint<&'n str>> {
        self.joints.iter().copied()
    }
    fn each(&self) -> impl Iterator<Item = [f64; 2]> {
        self.forces.into_iter()
    }
}

impl Texts {
    fn named<X>(&self, found: Result<X, MotionError>) -> Fallible<'_, X> {
        found.map_err(|error| match error {
            MotionError::NoInertia { scene, coordinate, share } => {
                MotionError::NoInertia { scene: self.own(scene), coordinate: self.own(coordinate), share }
            }
            MotionError::Position(error) => MotionError::Position(self.position_error(error)),
            MotionError::Input(error) => MotionError::Input(self.input_error(error)),
            other => panic!("{other}"),
        })
    }
}

fn row<U: Dim, V: Dim, C: Dim>(of: &ReactionRow<f64, U, V, C>) -> ReactionRow<f64, Unknowns, Inputs, Contacts> {
    ReactionRow {
        constant: of.constant,
        unknowns: column(&of.unknowns),
        inputs: column(&of.inputs),
        rows: column(&of.rows),
        contacts: column(&of.contacts),
    }
}

impl<'n, S> Scene for SceneAtRunTime<'n, S>
where
    S: Scene<Scalar = f64, Mechanism: Mechanism<Name = &'static str>>,
{
    type Scalar = f64;
    type U = Unknowns;
    type V = Inputs;
    type State = UpTo<13>;
    type Contacts = Contacts;
    type Mechanism = MechanismAtRunTime<'n, S::Mechanism>;
    type Reactions = Forces<'n>;

    // A constant of a scene at run time that an algorithm reads does not compile.
    const NAME: &'static str = panic!("a name of a value");
    const BEARINGS: bool = panic!("frictions of a value");
    const KINKS: &'static [Kink] = panic!("kinks of a value");

    fn name(&self) -> &'n str {
        self.texts.own(S::NAME)
    }
    fn has_bearings(&self) -> bool {
        self.of.has_bearings()
    }
    fn kinks(&self) -> impl Iterator<Item = Kink<&'n str>> {
        let texts = self.texts;
        self.of.kinks().map(|kink| kink.map_names(|name| texts.own(name)))
    }
    fn joints(&self) -> impl Iterator<Item = Joint<&'n str>> {
        self.joints.iter().copied()
    }
    fn mechanism(&self) -> &MechanismAtRunTime<'n, S::Mechanism> {
        &self.mechanism
    }
    fn contact_count(&self) -> Contacts {
        Contacts::new(self.contacts).expect("few contacts")
    }
    fn state(q: &Split, input_rates: &Column<f64, Inputs>) -> State {
        column(&S::state(&q.coordinates::<S::Mechanism>(), &column(input_rates).into()))
    }
    fn parts(state: &State) -> StateParts<Split, Column<f64, Inputs>> {
        let StateParts { q, input_rates } = S::parts(&column(state));
        StateParts { q: Split::of::<S::Mechanism>(&q), input_rates: column(&input_rates.into()) }
    }
    fn check(&self) -> Fallible<'n, ()> {
        self.texts.named(self.of.check())
    }
    fn derivative(&self, t: f64, state: &State) -> Fallible<'n, State> {
        self.texts.named(self.of.derivative(t, &column(state))).map(|found| column(&found))
    }
    fn equations(&self, t: f64, state: &State) -> Fallible<'n, Equations<f64, Unknowns, Inputs>> {
        let Equations { mass, forces, ratios, bias } = self.texts.named(self.of.equations(t, &column(state)))?;
        Ok(Equations { mass: matrix(&mass), forces: column(&forces), ratios: matrix(&ratios), bias: column(&bias) })
    }
    fn contacts(
        &self,
        t: f64,
        q: &Split,
        rates: &Split,
    ) -> Fallible<'n, Column<Contact<f64, Unknowns, Inputs, &'n str>, Contacts>> {
        let (q, rates) = (q.coordinates::<S::Mechanism>(), rates.rates::<S::Mechanism>());
        let found = self.texts.named(self.of.contacts(t, &q, &rates))?;
        Ok(self.contact_count().column(|place| {
            let Contact { name, along, law } = found[place];
            let ContactCoordinate { value, unknowns, inputs, bias } = along;
            let along = ContactCoordinate { value, unknowns: column(&unknowns), inputs: column(&inputs), bias };
            Contact { name: self.texts.own(name), along, law }
        }))
    }
    fn bearings(&self, t: f64, q: &Split, rates: &Split) -> Fallible<'n, Column<Option<BearingHere>, Contacts>> {
        let (q, rates) = (q.coordinates::<S::Mechanism>(), rates.rates::<S::Mechanism>());
        let found = self.texts.named(self.of.bearings(t, &q, &rates))?;
        Ok(self.contact_count().column(|place| {
            found[place].map(|Bearing { components }| Bearing { components: components.map(|of| row(&of)) })
        }))
    }
    fn unreduced(&self, t: f64, q: &Split, rates: &Split) -> Fallible<'n, Unreduced<f64, Unknowns, Inputs>> {
        let (q, rates) = (q.coordinates::<S::Mechanism>(), rates.rates::<S::Mechanism>());
        let all = self.texts.named(self.of.unreduced(t, &q, &rates))?;
        Ok(Unreduced {
            unknowns: matrix(&all.unknowns),
            mixed: matrix(&all.mixed),
            inputs: matrix(&all.inputs),
            unknown_forces: column(&all.unknown_forces),
            input_forces: column(&all.input_forces),
        })
    }
    fn reactions(
        &self,
        t: f64,
        q: &Split,
        rates: &Split,
        accelerations: &Accelerations<Self>,
        contact_forces: &Column<f64, Contacts>,
    ) -> Fallible<'n, Forces<'n>> {
        let (q, rates) = (q.coordinates::<S::Mechanism>(), rates.rates::<S::Mechanism>());
        let accelerations =
            Accelerations::<S> { unknowns: column(&accelerations.unknowns), inputs: column(&accelerations.inputs) };
        let found = self.of.reactions(t, &q, &rates, &accelerations, &column(contact_forces));
        let forces: Vec<[f64; 2]> = self.texts.named(found)?.each().collect();
        let count = MostJoints::new(forces.len()).expect("few joints");
        Ok(Forces { joints: self.joints, forces: count.array(|place| forces[place]) })
    }
    fn kink(&self, place: usize, t: f64, q: &Split, rates: &Split) -> f64 {
        self.of.kink(place, t, &q.coordinates::<S::Mechanism>(), &rates.rates::<S::Mechanism>())
    }
    fn kinetic_and_potential(&self, q: &Split, input_rates: &Column<f64, Inputs>) -> Fallible<'n, Option<Energy<f64>>> {
        let q = q.coordinates::<S::Mechanism>();
        self.texts.named(self.of.kinetic_and_potential(&q, &column(input_rates).into()))
    }
    fn prescribed(&self, t: f64) -> Column<Option<Prescribed<f64>>, Inputs> {
        column(&self.of.prescribed(t))
    }
}
