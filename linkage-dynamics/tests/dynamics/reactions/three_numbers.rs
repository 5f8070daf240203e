//! The common parts of mechanisms and scenes with the coordinates [u1, u2, v].

/// The types of a `Mechanism`, and the order of the coordinates.
macro_rules! mechanism {
    () => {
        type Scalar = f64;
        type Name = &'static str;
        type U = D<2>;
        type V = D<1>;
        type G = D<1>;
        type Coordinates = [f64; 3];
        type Rates = [f64; 3];
        type Inputs = Column<f64, D<1>>;
        type Pose = [f64; 3];
        type Branch = ();

        fn coordinates(unknowns: Column<f64, D<2>>, inputs: Column<f64, D<1>>) -> [f64; 3] {
            [unknowns[0], unknowns[1], inputs[0]]
        }
        fn parts([first, second, input]: &[f64; 3]) -> (Column<f64, D<2>>, Column<f64, D<1>>) {
            ([*first, *second].into(), [*input].into())
        }
        fn rates(unknowns: Column<f64, D<2>>, inputs: Column<f64, D<1>>) -> [f64; 3] {
            Self::coordinates(unknowns, inputs)
        }
        fn rate_parts(rates: &[f64; 3]) -> (Column<f64, D<2>>, Column<f64, D<1>>) {
            Self::parts(rates)
        }
        fn pose_at(&self, q: &[f64; 3]) -> [f64; 3] {
            *q
        }
        fn is_finite(pose: &[f64; 3]) -> bool {
            pose.iter().all(|number| number.is_finite())
        }
        fn branch_of(&self, _: &[f64; 3]) {}
    };
}

/// The types of a `Scene`, the state, its derivative from `equations`; no drives and no forces in joints.
macro_rules! scene {
    () => {
        type Scalar = f64;
        type U = D<2>;
        type V = D<1>;
        type State = D<4>;
        type Reactions = ();

        fn state(q: &[f64; 3], input_rates: &Column<f64, D<1>>) -> StateColumn<Self> {
            [q[0], q[1], q[2], input_rates[0]].into()
        }
        fn parts(state: &StateColumn<Self>) -> StateParts<[f64; 3], Column<f64, D<1>>> {
            StateParts { q: [state[0], state[1], state[2]], input_rates: [state[3]].into() }
        }
        fn check(&self) -> Result<(), MotionError> {
            Ok(())
        }
        fn derivative(&self, t: f64, state: &StateColumn<Self>) -> Result<StateColumn<Self>, MotionError> {
            let Equations { mass, forces, ratios, .. } = self.equations(t, state)?;
            let unknowns = ratios * Column::from([state[3]]);
            Ok([unknowns[0], unknowns[1], state[3], forces[0] / mass[(0, 0)]].into())
        }
        fn reactions(
            &self,
            _: f64,
            _: &[f64; 3],
            _: &[f64; 3],
            _: &Accelerations<Self>,
            _: &Column<f64, Self::Contacts>,
        ) -> Result<(), MotionError> {
            Ok(())
        }
        fn prescribed(&self, _: f64) -> Column<Option<Prescribed<f64>>, D<1>> {
            [None].into()
        }
    };
}

pub(crate) use {mechanism, scene};
