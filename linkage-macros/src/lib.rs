//! The `linkage!` macro: closure equations in, specialised Rust out.
//!
//! Use it through the `linkage` crate. [`linkage!`] is the manual of the language.

#![warn(missing_docs)]

use linkage_compiler::Facade;
use linkage_compiler::budget::Budget;
use proc_macro::TokenStream;

/// A mechanism from its closure equations.
///
/// The macro differentiates the closures symbolically at compile time and emits functions for the
/// constraint Jacobian, the velocity ratios, velocities, accelerations, points and outputs.
///
/// # A mechanism
///
/// ```
/// use linkage::linkage;
///
/// linkage! {
///     /// Four-bar linkage; the closure runs A-B-C-D with l4 from C to D.
///     #[derive(Debug, Clone, PartialEq)]
///     pub mechanism FourBar {
///         param l1 = 80.0, l2 = 20.0, l3 = 50.0, l4 = 70.0;
///         input   theta2;
///         unknown theta3, theta4;
///
///         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
///
///         point B  = l2@theta2;
///         point C  = B + l3@theta3;
///         /// Middle of the coupler.
///         point G3 = B + (l3/2)@theta3;
///         output mu = theta3 - theta4;
///     }
/// }
///
/// let four_bar = FourBar::default();
/// let guess = FourBarCoordinates { theta2: 0.35, theta3: 1.2, theta4: -0.9 };
/// let solution = four_bar.solve(&guess)?;
/// let motion = four_bar.motion(&solution.coordinates, 41.9, 0.0)?;
/// assert!((motion.rates.theta3 + 18.4).abs() < 0.1);
/// assert!(motion.points.g3.position.y > 30.0);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// `mechanism NAME { statements }`: attributes, doc comments and visibility go to the type of the
/// parameters. Several mechanisms may stand in one invocation, and an invocation may stand in a module,
/// a function body or a test. Statements may stand in any order, but for `let`, `point` and `output`,
/// which use only what is above them. Doc comments on a statement reach the fields it declares.
///
/// Attributes go where they have a meaning, and are refused elsewhere:
///
/// | on | what becomes of it |
/// |---|---|
/// | `mechanism` | `cfg` applies to all items that are emitted, so that a mechanism is there as a whole or not at all; `allow`, `warn`, `deny` and `forbid` as well; everything else, such as `derive` and its like, goes to the types that hold parameters |
/// | `drive`, `scene` | all go to its type |
/// | `param` | all go to its field, such as `#[serde(rename = "…")]` |
/// | `input`, `unknown`, `coordinate`, `point`, `output`, `loop`, `equation`, `extern fn` | doc comments go to the documentation |
/// | `let`, `derive`, `body`, effects | doc comments, for the reader of the source |
///
/// `cfg` on a part of a mechanism is refused, since a macro runs before it is evaluated: write one mechanism for each case.
/// A mechanism that is configured out is read all the same. `deprecated` is refused, since emitted code would warn of itself.
///
/// | statement | meaning |
/// |---|---|
/// | `param a = 1, b;` | geometric and physical data; a default is a number. With defaults for all there is `Default` |
/// | `input v;` | independent coordinates, one per degree of freedom |
/// | `unknown u;` | dependent coordinates, as many as there are closure rows |
/// | `loop VECTOR = VECTOR;` | a vector closure, two rows; the right side may be `0` |
/// | `equation SCALAR = SCALAR;` | a scalar closure, one row: gears, rolling, cams, loops by component |
/// | `let NAME = EXPRESSION;` | a named subexpression, scalar or vector |
/// | `point NAME = VECTOR;` | a point whose position, velocity and acceleration are wanted |
/// | `output NAME = SCALAR;` | any scalar quantity of interest |
/// | `extern fn PATH(x, p) -> (f, df, ddf);` | a function of your own with its derivatives, see below |
/// | `coordinate q;` and `drive NAME by q;` | the same mechanism with a choice of input, see below |
/// | `derive jerk, sensitivity;` | higher orders and sensitivities, see below |
/// | `body NAME { mass m; inertia j; center G; angle phi; }` | a rigid body, see below |
/// | `scene NAME { inertia; gravity (0, -g); }` | the mechanism with forces, see below |
///
/// Fields are snake case: the point `G3` is the field `g3`.
///
/// # Expressions
///
/// | form | meaning |
/// |---|---|
/// | `r@phi` | the vector of modulus `r` at the angle `phi`: (r cos phi, r sin phi) |
/// | `(x, y)` | a vector by components |
/// | `(x, y)@phi` | the local vector (x, y) rotated by `phi` |
/// | `+ - * /`, unary `-` | as usual; vector plus vector, scalar times vector |
/// | `x^n`, `powi(x, n)`, `x.powi(n)` | whole powers |
/// | `sin cos tan asin acos atan atan2 sqrt abs exp ln hypot` | scalar functions; `x.sqrt()` is `sqrt(x)` |
/// | `x(P) y(P) norm(V) angle(V) dot(A, B) cross(A, B)` | of vectors |
/// | `f(x, p)` | a function of your own, or a derivative of one, under the name that `extern fn` gives it |
/// | `pi`, `20deg`, `1.5`, `3` | constants; integers, decimals and their ratios stay exact |
///
/// A constant, also one that comes of several or of a derivative, is zero or a normal number of `f64`, 2.3e-308 to 1.7e308;
/// else it is refused. Another scalar takes it from `f64`: an `f32` rounds it, to infinity beyond 3.4e38, which functions
/// that return a `Result` report as `NotFinite`, and to zero below 7e-46.
///
/// `@` binds tighter than `+ -` and looser than `* /`, so `l3/2 @ phi + s @ (phi - delta)` needs no
/// more parentheses than these. Angles are in radians. Whether a name is an angle or a length follows
/// from its use, and stands in the documentation of its field.
///
/// ```
/// linkage::linkage! {
///     /// A slider on an arm, with an offset, and a point off the line of the arm.
///     pub mechanism Arm {
///         param z1 = 1, z3 = 0.5, z4 = 3, delta = 60deg;
///         input phi1;
///         unknown phi2, z2;
///         let arm = z2@phi2 + z3@(phi2 - delta);
///         loop z1@phi1 + arm = (z4, 0);
///         point P = z1@phi1 + (z2 / 2, 0.25)@phi2;
///         output reach = norm(arm);
///     }
/// }
/// let arm = Arm::default();
/// let q = arm.solve(&ArmCoordinates { phi1: 1.0, phi2: -0.2, z2: 2.0 })?.coordinates;
/// let pose = arm.pose_at(&q);
/// // Equation 1.1 of the lecture notes: J is singular where z2 + z3 cos(delta) = 0.
/// assert!((arm.determinant(&pose) + q.z2 + 0.25).abs() < 1e-15);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// A scalar closure where there is no loop to close:
///
/// ```
/// linkage::linkage! {
///     mechanism Gears {
///         param teeth1 = 20, teeth2 = 45;
///         input phi1;
///         unknown phi2;
///         equation teeth1 * phi1 + teeth2 * phi2 = 0;
///     }
/// }
/// let gears = Gears::default();
/// let pose = gears.pose_at(&GearsCoordinates { phi1: 0.0, phi2: 0.0 });
/// assert_eq!(gears.velocity_ratios(&pose)?[0], -20.0 / 45.0);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// # Functions of your own
///
/// A cam law or a table is a generic function that returns its value and its derivatives by the first argument:
///
/// ```
/// use linkage::{Real, linkage};
///
/// /// Rise of the height h over the angle beta by cycloidal motion, with three derivatives.
/// fn rise<T: Real>(phi: T, h: T, beta: T) -> (T, T, T, T) {
///     let k = T::two_pi() / beta;
///     let (sine, cosine) = (k * phi).sin_cos();
///     let mean = h / beta;
///     (mean * (phi - sine / k), mean * (T::one() - cosine), mean * k * sine, mean * k * k * cosine)
/// }
///
/// linkage! {
///     /// Disc cam with a translating roller follower.
///     pub mechanism Cam {
///         param radius = 40, h = 20, beta = 120deg;
///         input phi;
///         unknown s;
///         extern fn rise(phi, h, beta) -> (lift, slope, bend, change);
///         equation s = lift(phi, h, beta);
///         point Pitch = (radius + s)@(-phi);
///         output pressure = atan(slope(phi, h, beta) / (radius + s));
///     }
/// }
/// let cam = Cam::default();
/// let pose = cam.assemble(60_f64.to_radians(), CamBranch {})?;
/// // In the middle of the rise the follower is fastest: 2 h / beta.
/// assert!((cam.velocity(&pose, 1.0)?.s - 2.0 * cam.h / cam.beta).abs() < 1e-14);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// The function behind the path takes as many `T` as there are arguments, and returns a tuple of as many `T` as
/// there are names: its value, and its first, second, ... derivative by the first argument. In expressions each
/// of these is a function under its name. The further arguments are parameters: what is written there must not
/// move. Closures, points and outputs take two derivatives more than the highest that they name; an error says
/// if the function gives fewer.
///
/// The function is called once for each argument at which it is used, however many derivatives are taken, and a
/// pose holds the values. NaN, where it has no value, becomes the error `NotFinite`. The argument may be an
/// unknown; such a position is found by `solve`, and there is no `assemble`.
///
/// # Driven by another coordinate
///
/// Which configurations are singular depends on the coordinate that drives. A mechanism may leave the
/// choice open; each `drive` is a type of its own with the same parameters, and the coordinates are the
/// same for all, so that a position found with one driver is good for every other.
///
/// ```
/// linkage::linkage! {
///     #[derive(Clone)]
///     pub mechanism SliderCrank {
///         param r, l;
///         coordinate phi1, phi2, z3;
///         loop r@phi1 + l@phi2 = z3@0;
///         drive Compressor by phi1;
///         drive Engine     by z3;
///     }
/// }
/// let slider_crank = SliderCrank::new(1.0, 3.0);
/// let (compressor, engine) = (Compressor::from(slider_crank.clone()), Engine::from(slider_crank));
/// let dead_centre = SliderCrankCoordinates { phi1: 0.0, phi2: 0.0, z3: 4.0 };
/// assert!(compressor.velocity_ratios(&compressor.pose_at(&dead_centre)).is_ok());
/// assert!(engine.velocity_ratios(&engine.pose_at(&dead_centre)).is_err());
/// ```
///
/// # Higher orders and sensitivities
///
/// What not every mechanism needs is derived where a `derive` statement names it, for every driver, with the
/// same formulas of the blocks or the same factorisation as velocity:
///
/// | word | functions |
/// |---|---|
/// | `limits` | `limits(v, branch)`, of several inputs `limits_of_NAME`: the input interval about a position in which the mechanism can be assembled, exact where a group depends on the inputs alone, also through linear equations, bracketed by search where groups depend on others; inputs at which a group is undetermined are passed |
/// | `jerk` | `jerk(&pose, &q', &q'', v''')` from J u''' = -(A v''' + eta), of any number of inputs and along any input path; `point_jerks`, `output_jerks` |
/// | `velocity_ratio_derivatives` | the function of this name: d2u/dv dv, of each unknown a symmetric matrix L with u'' = W v'' + v' . L v' (velocity coefficients and their derivatives in S. Doughty, "Mechanics of Machines"); `point_ratio_derivatives`, `output_ratio_derivatives` |
/// | `sensitivity` | the function of this name: du/dp = -J^-1 `Psi_p` at fixed inputs, one column a parameter; `point_sensitivities`, `output_sensitivities`, which hold what depends on the parameters directly, too |
///
/// ```
/// linkage::linkage! {
///     /// A piston: what a tolerance of its rod does to it, and how smoothly it moves.
///     pub mechanism Piston {
///         param r = 1, l = 3;
///         input phi;
///         unknown psi, x;
///         loop r@phi + l@psi = (x, 0);
///         output stroke = x - l;
///         derive limits, jerk, velocity_ratio_derivatives, sensitivity;
///     }
/// }
/// let piston = Piston::default();
/// let q = piston.solve(&PistonCoordinates { phi: 0.0, psi: 0.1, x: 3.9 })?.coordinates;
/// let pose = piston.pose_at(&q);
/// // At the dead centre: x = 4, dx/dr = dx/dl = 1, and the output less its l does not depend on the rod.
/// assert_eq!(piston.sensitivity(&pose)?.row(1).iter().copied().collect::<Vec<f64>>(), [1.0, 1.0]);
/// assert_eq!(piston.output_sensitivities(&pose)?.stroke[1], 0.0);
/// // d2x/dphi2 = -r (1 + r/l).
/// let [_, x] = piston.velocity_ratio_derivatives(&pose)?;
/// assert!((x[(0, 0)] + 4.0 / 3.0).abs() < 1e-14);
/// // x is even in phi, so that at constant speed there is no jerk here.
/// let rates = piston.velocity(&pose, 1.0)?;
/// let accelerations = piston.acceleration(&pose, &rates, 0.0)?;
/// assert!(piston.jerk(&pose, &rates, &accelerations, 0.0)?.x.abs() < 1e-14);
/// // With a rod half as long as the crank the joint stays within 30 degrees of the line.
/// let short = Piston::new(2.0, 1.0);
/// let limits = short.limits(0.1, PistonBranch { psi: linkage::Slope::Rising })?;
/// assert!((limits.upper.input().unwrap() - std::f64::consts::FRAC_PI_6).abs() < 1e-15);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// # Scenes: only the effects called for
///
/// A mechanism alone is kinematics. A `scene` adds effects, and is a type of its own: it holds the mechanism and the
/// parameters of the effects that it names. What it does not name is not in the type, not in the code and costs
/// nothing: `cargo bench --bench effects` prints the operations and the time of each. Parameters are declared together;
/// one that no closure, point or output holds belongs to the scenes that hold it and not to the mechanism.
///
/// ```
/// linkage::linkage! {
///     #[derive(Clone, Debug)]
///     pub mechanism FourBar {
///         param l1 = 0.8, l2 = 0.2, l3 = 0.5, l4 = 0.7;
///         param j2 = 0.02, m3 = 2.5, j3 = 0.05, g = 9.81, kt = 4, ct = 0.6, t0 = 3, omega = 12;
///         input theta2;
///         unknown theta3, theta4;
///         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
///         point G3 = l2@theta2 + (l3/2)@theta3;
///
///         body crank { inertia j2; angle theta2; }
///         body coupler { mass m3; inertia j3; center G3; angle theta3; }
///
///         scene Loaded {
///             inertia;
///             gravity (0, -g);
///             spring kt, -1.2 on theta4;
///             damper ct on theta4;
///             torque t0 on theta2;
///             energy;
///         }
///         /// What it takes to turn the crank like this.
///         scene Driven {
///             inertia;
///             drive theta2 = omega * t;
///             reactions;
///         }
///     }
/// }
/// use linkage::Scene;
///
/// let loaded = Loaded { g: 1.62, ..Loaded::default() };
/// let q = FourBarCoordinates { theta2: 0.35, theta3: 1.2, theta4: -0.9 };
/// let q = loaded.mechanism.solve(&q)?.coordinates;
/// // M v'' = Q, reduced to the crank.
/// let acceleration = loaded.acceleration(0.0, &q, 41.9)?.theta2;
/// let (mass, force) = (loaded.mass_matrix(&q)?[0], loaded.forces(0.0, &q, 41.9)?[0]);
/// assert!((mass * acceleration - force).abs() < 1e-12 * force.abs());
/// assert!(loaded.energy(&q, 41.9)?.kinetic > 0.0);
/// // What an integrator takes: y = (q, v') and y' = (q', v'').
/// let state = loaded.start(0.0, &q, &41.9.into())?;
/// assert_eq!(loaded.derivative(0.0, &state)?[3], acceleration);
///
/// let driven = Driven::default();
/// let [linkage::Prescribed { rate: speed, .. }] = driven.drives(0.0);
/// let [torque] = driven.drive_forces(0.0, &q, speed)?;
/// assert!(torque.abs() < 1e3 && driven.reactions(0.0, &q, speed)?.norm() > 0.0);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// | in a scene | meaning |
/// |---|---|
/// | `inertia;` | of all bodies; `inertia crank, rod;` of these. Without it nothing accelerates: the scene is statics |
/// | `gravity (0, -g);` | the weight of all bodies; `gravity (0, -g) on rod;` of these |
/// | `spring k, s0 between P and Q;` | a linear spring: stiffness and free length, which may be left out |
/// | `spring k, phi0 on phi;` | a spring on any scalar: coordinate, output or expression |
/// | `damper c between P and Q;`, `damper c on phi;` | a force against the rate; c may be a law |
/// | `torque LAW on phi;` | a torque on an angle, or a force on a length: its work is LAW times the change of `phi` |
/// | `force (fx, fy) at P;` | a force at a point |
/// | `potential V;` | forces from any potential energy |
/// | `friction mu, radius, normal on phi;` | dry friction in a joint: its greatest torque is the product, of which each factor may be a law |
/// | `friction mu, normal on s;` | the same along a length |
/// | `stop s in lower..upper, restitution e;` | s stays within this range, and goes back with the part e of its rate |
/// | `drive v = LAW;` | the motion of an input is given: what drives it is found by inverse dynamics |
/// | `energy;`, `power;`, `reactions;`, `equilibrium;` | more functions |
///
/// A LAW may hold parameters, coordinates, outputs, their rates as `rate(x)`, and time `t`; that of a `drive` time and
/// parameters alone. Where a mechanism leaves its input open, a scene says which driver it takes:
/// `scene Fired of Engine { … }`.
///
/// | item of a scene | what |
/// |---|---|
/// | `mechanism`, `new`, `Default`, `map`, conversion from the mechanism and an array | the kinematics, and the parameters of the effects |
/// | `mass_matrix(&q)` | M = sum m `W_G`' `W_G` + j w' w, reduced to the inputs; with `inertia` |
/// | `forces(t, &q, v')` | Q with the quadratic velocity terms |
/// | `acceleration(t, &q, v')`, `rates(t, &q, v')` | v'', and q' with v''; with `inertia` |
/// | `drives(t)`, `drive_forces(t, &q, v')` | value, rate and acceleration of what is driven, and the forces that it takes: M v'' - Q |
/// | `DERIVATION` | the equations of motion as data: M, the share of each body and each effect in Q, the potential energy; `sheet` shows them |
/// | `energy(&q, v')`, `power(t, &q, v')` | kinetic and potential energy; the power that is applied, also by drives, and that is dissipated |
/// | `reactions(t, &q, v')` | Lagrange's multipliers: the force where a loop is cut, of its left side on its right side |
/// | `equilibrium(t, &guess)` | the position near the guess where the forces of the inputs that are not driven vanish at rest, by Newton's method; `balance(t, &q)`: these forces and their derivatives, whose signs tell what is stable |
/// | `check()` | refuses by their name negative masses, inertias and frictions, empty ranges of stops, and restitutions that are not between 0 and 1 |
/// | `unreduced(t, &q, &q')` | with `inertia`: M and F of `M q'' + Psi_q' lambda = F` in all coordinates, whichever are independent; without frictions and stops |
/// | the trait `Scene` | with `inertia`: the state (q, v') of an integrator, its derivative, its projection on the closures; `contacts`: each friction and stop with its scalar and its limits; `equations`: M, Q, W and u'' at v'' = 0, without them |
///
/// ## Simulation
///
/// `simulation::simulate` takes a scene with `inertia`, also one with frictions and stops, from a start to an end, and
/// gives the states with all coordinates and rates by name. It goes through dead points of the input, in other
/// coordinates, and straight on through change points; what it cannot follow is an error, and what was computed stays.
///
/// ```
/// linkage::linkage! {
///     #[derive(Debug, Clone)]
///     pub mechanism Engine {
///         param r = 0.05, l = 0.18, j = 0.01, m = 0.9, g = 9.81;
///         input z;
///         unknown phi, psi;
///         loop r@phi + l@psi = (z, 0);
///         body crank { inertia j; angle phi; }
///         body piston { mass m; center (z, 0); }
///         scene Running { inertia; gravity (0, -g); energy; }
///     }
/// }
/// use linkage::integrate::Crossing;
/// use linkage::simulation::{Then, simulate};
///
/// let scene = Running::default();
/// let start = EngineCoordinates { z: 0.2, phi: 0.7, psi: -0.2 };
/// // The time, a position near that of this z, and z'; the end; the relative error allowed of a step.
/// let mut motion = simulate(&scene, (0.0, start, -1.0), 1.0, 1e-9)?;
/// for state in motion.at([0.25, 0.5, 0.75, 1.0]) {
///     let state = state?;
///     println!("{:4} s: {:8.5} rad, {:8.5} rad/s", state.t, state.q.phi, state.rates.phi);
/// }
/// // The piston drives it over both dead points, turn after turn.
/// assert!(motion.state().q.phi > 6.5 && motion.passages().exchanges > 4);
///
/// // Up to the end of the first turn.
/// let turn = |phi: f64| phi - std::f64::consts::TAU;
/// let motion = simulate(&scene, (0.0, start, -1.0), 1.0, 1e-9)?;
/// let mut motion = motion.events([Crossing::Rising], |state| Ok([turn(state.q.phi)]), |_, _| Ok(Then::Stop))?;
/// motion.finish(|_state, _progress| true)?;
/// assert!(turn(motion.state().q.phi).abs() < 1e-12);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// A mechanism, its path and its simulation are fields of your own struct by the mechanism and the scene alone; functions
/// for any of them take `M: Mechanism` and `S: Scene`.
///
/// ```
/// # linkage::linkage! {
/// #     #[derive(Debug, Clone)]
/// #     pub mechanism Engine {
/// #         param r = 0.05, l = 0.18, j = 0.01, m = 0.9, g = 9.81;
/// #         input z;
/// #         unknown phi, psi;
/// #         loop r@phi + l@psi = (z, 0);
/// #         body crank { inertia j; angle phi; }
/// #         body piston { mass m; center (z, 0); }
/// #         scene Running { inertia; gravity (0, -g); }
/// #     }
/// # }
/// use linkage::Mechanism;
/// use linkage::continuation::{Direction, Path, PathStep};
/// use linkage::simulation::{Simulation, simulate};
///
/// struct Bench<'a> {
///     engine: Engine,
///     by_hand: Path<'a, Engine>,
///     by_weight: Simulation<'a, Running>,
///     reached: Vec<PathStep<Engine>>,
/// }
///
/// /// The largest residual of the closures, of any mechanism.
/// fn gap<M: Mechanism<Scalar = f64>>(mechanism: &M, q: &M::Coordinates) -> f64 {
///     mechanism.residual(&mechanism.pose_at(q)).largest()
/// }
///
/// let (engine, scene) = (Engine::default(), Running::default());
/// let start = EngineCoordinates { z: 0.2, phi: 0.7, psi: -0.2 };
/// let mut bench = Bench {
///     engine: engine.clone(),
///     by_hand: Path::new(&engine, &start, Direction::Decreasing)?,
///     by_weight: simulate(&scene, (0.0, start, -1.0), 1.0, 1e-9)?,
///     reached: Vec::new(),
/// };
/// bench.reached.push(bench.by_hand.advance_to(0.16)?);
/// bench.by_weight.finish(|_state, _progress| true)?;
/// assert!(gap(&bench.engine, &bench.reached[0].position) < 1e-15);
/// assert!(gap(&bench.engine, &bench.by_weight.state().q) < 1e-15);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// ## Dry friction and stops
///
/// Frictions and stops act on a coordinate, an output or any other scalar that moves. They jump where the
/// others are smooth: a joint sticks or slips, a stop is open or closed. So what a scene says of itself (`forces`,
/// `acceleration`, `drive_forces`, `reactions`, `equilibrium`, `derivative` of the trait `Scene`) is **without** them;
/// `contacts` tells where they are, and the module `contact` of the runtime has the law: which modes fit a state, the
/// accelerations and forces in them, the functions whose zeros are the events, and what happens there. A simulation
/// does all of this: its states tell what each friction and stop is doing, and what has happened to it.
///
/// ```
/// linkage::linkage! {
///     #[derive(Clone, Debug)]
///     pub mechanism Press {
///         param r = 0.1, l = 0.35, j = 0.02, m = 0.8;
///         param mu = 0.2, normal = 40, radius = 0.01, load = 90, torque = 0.5, e = 0.3;
///         input phi;
///         unknown psi, z;
///         loop r@phi - l@psi = (z, 0);
///         output joint = phi - psi;
///         body crank { inertia j; angle phi; }
///         body ram { mass m; center (z, 0); }
///
///         scene Working {
///             inertia;
///             torque torque on phi;
///             friction mu, radius, load on joint;
///             friction mu, normal on z;
///             stop z in 0.26..0.6, restitution e;
///         }
///     }
/// }
/// use linkage::contact::{Contacts, ReducedEquations};
/// use linkage::{Column, D, Mode, Scene};
///
/// let press = Working::default();
/// let guess = PressCoordinates { phi: 1.2, psi: 2.9, z: 0.4 };
/// let state = press.start(0.0, &guess, &0.0.into())?;
/// let (q, rates) = Working::parts(&state);
/// let at = |v: &Column<f64, D<1>>| ReducedEquations::of(&press, 0.0, &Working::state(&q, &(*v).into()));
/// // Half a newton metre is less than the friction of the ram holds at this lever.
/// let (contacts, rates) = Contacts::begin(0.0, &rates.into(), at)?;
/// assert_eq!(contacts.modes, [Mode::Stick, Mode::Stick, Mode::Open]);
/// assert_eq!(contacts.motion(&at(&rates)?)?.acceleration[0], 0.0);
///
/// // Ten times as much moves it.
/// let press = Working { torque: 5.0, ..press };
/// let at = |v: &Column<f64, D<1>>| ReducedEquations::of(&press, 0.0, &Working::state(&q, &(*v).into()));
/// let (contacts, rates) = Contacts::begin(0.0, &rates, at)?;
/// assert_eq!(contacts.modes, [Mode::SlipForward, Mode::SlipBackward, Mode::Open]);
/// assert!(contacts.motion(&at(&rates)?)?.acceleration[0] > 50.0);
///
/// // The ram goes down to its stop, bounces, and rests on it.
/// use linkage::contact::Change;
/// use linkage::simulation::simulate;
///
/// let mut motion = simulate(&press, (0.0, q, 0.0), 1.0, 1e-10)?;
/// let (mut impacts, mut last) = (0, None);
/// for state in motion.by_ref() {
///     let state = state?;
///     for (name, change) in state.changes() {
///         println!("{:.6} s: {name} {change:?}", state.t);
///         impacts += usize::from(change == Change::Impact);
///         last = Some((name, change));
///     }
/// }
/// assert_eq!((impacts > 3, last), (true, Some(("stop on z", Change::Rests))));
/// let end = motion.state();
/// assert_eq!((end.mode("stop on z"), end.rates.z), (Some(Mode::AtLower), 0.0));
/// // The stop carries what the motor presses: by the lever dz/dphi less than 5 N m would suggest.
/// let ratio = press.mechanism.motion(&end.q, 1.0, 0.0)?.rates.z;
/// println!("{:.1} N", motion.loads()?.contacts[2] * ratio);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// - What sticks holds up to its limit; several joints of one input hold together while |Q| is not more than the sum of
///   |ds/dv| limit. Static and sliding limit are the same unless the limit is a law of `rate(s)`.
/// - At an impact s'+ = -e s'-; what rests on another stop is not pushed through it. Impulses of friction are neglected.
/// - Bouncing ends where the rebound is less than the square root of the scalar's rounding beside the hardest impact of
///   the series, or no higher than one rounding of the place.
/// - A stop is met however briefly it is touched within a step, if its gap shrinks and grows once in the step.
///   What sticks or slips, and your own events, are found if they turn once in a step; what turns more often in one step
///   may be missed: of random sums of sines 0.1 % with two extrema in a step, 1 % with three, 5 % with four, 25 % with five. The module
///   `integrate` says it in full; `largest_step` makes it finer.
/// - What rests on a stop without a load rests there, and so do two bodies that have met without rebound.
/// - Time runs forward: a simulation back in time of a scene with frictions or stops is `MotionError::Irreversible`.
/// - `power` counts limit |s'| of each friction as dissipated; in scenes with contacts it leaves out the power of drives,
///   which depends on what sticks: `loads` of a simulation has it, with the forces of frictions, stops and drives.
///
/// Effects work along what the closures, points and bodies already compute: one kernel holds all that a function
/// returns, and takes coordinates that close the mechanism, so that an angle beyond a turn is what it is.
///
/// # What is emitted for `mechanism FourBar`
///
/// q are all coordinates, v the inputs, u the unknowns, Psi(q) = 0 the closures, J = `Psi_u`,
/// A = `Psi_v`, W = -J^-1 A and gamma = `(Psi_q q')_q q'`, so that u' = W v' and J u'' = -(A v'' + gamma).
///
/// | item | what |
/// |---|---|
/// | `FourBar<T = f64>` | the parameters; `new` up to seven of them, `Default` for `f64`, `map` to another scalar, conversions from and to arrays |
/// | `FourBarCoordinates<T>`, `FourBarRates<T>`, `FourBarAccelerations<T>` | q, q' and q'' by name, with `derive jerk` also `FourBarJerks<T>`, q'''; u before v; conversions from and to `SVector` |
/// | `FourBarInputs<T>` | v by name, also v' and v''; a single input also from the bare number, and all from q, q' or q'' |
/// | `FourBarPoints<Q>`, `FourBarOutputs<Q>` | the points and outputs by name |
/// | `motion(&q, v', v'')` | everything at once, each shared subexpression computed once: `FourBarMotion<T>` with `position`, `rates`, `accelerations`, `points` and `outputs` |
/// | `assemble(v, branch)` | position in closed form where every block has one: group by group, on the branch that is asked for |
/// | `assemble_near(&guess, branch)` | where a block has no closed form, instead of `assemble`: that block by Newton's method from the guess, all others in closed form; where the number of an angle matters, beside `assemble`: in the turn nearest to the guess, see below |
/// | `branches(v)` | every position that exists at these inputs, each with its branch, angles at their principal values; without the branches on which a group is undetermined |
/// | `FourBarBranch`, `branch_of(&pose)` | which of the two solutions of each group, by the names of its unknowns, and the turns of angles, see below; `new(..)` with all turns 0, `all()` of these |
/// | `solve(&guess)` | position by Newton's method on the branch of the guess, with its iterations and residual |
/// | `solve_any_branch(&guess)` | the same on whatever branch the search ends, and whether that is the branch of the guess |
/// | `FourBarPose<T>`, `pose_at(&q)` | directions, determinants, the inputs and the angles whose number matters, values of your own functions: what follows takes a pose and needs no trigonometry; `coordinates()` gives the coordinates back |
/// | `velocity(&pose, v')`, `acceleration(&pose, &q', v'')` | q' and q'' |
/// | `points(&pose)`, `point_velocities(&pose, &q')`, `point_accelerations(&pose, &q', &q'')` | of all points |
/// | `outputs(&pose)`, `output_velocities(&pose, &q')`, `output_accelerations(&pose, &q', &q'')` | of all outputs |
/// | `velocity_ratios`, `point_ratios`, `output_ratios` | W, and W_l with l' = W_l v' of each point and output |
/// | `residual`, `closure_sizes` | Psi, and the sum of the magnitudes of its terms |
/// | `jacobian`, `jacobian_unknowns`, `jacobian_inputs` | the whole of `Psi_q`, J and A |
/// | `determinant`, `block_determinants` | det J, and the determinants of its blocks in the order in which they are solved |
/// | `gamma(&pose, &q')`, `solve_jacobian(&pose, &r)` | the quadratic velocity term, and J^-1 r |
/// | `limits`, `jerk`, `velocity_ratio_derivatives`, `sensitivity` and the like of points and outputs | where a `derive` statement asks for them |
/// | `DERIVATION` | the derivation as data: every formula as Unicode text, LaTeX and MathML, the order of solution, the operations of each function; `sheet` makes a document of it |
///
/// Their errors are `PositionError`. `T` is any real scalar: `f32`, `f64`, dual numbers. Emitted code allocates nothing, cannot panic and
/// needs no standard library.
///
/// The closures are solved block by block: unknowns that depend on one another form a block, a block of
/// one or two unknowns has a formula, a larger one a factorisation. Dyads are recognised by the way their
/// unknowns enter the closure (RRR, RRP, RPR, two sliders) and named in the documentation and in
/// `DERIVATION`; they, single angles and linear unknowns have their positions in closed form. Two links
/// have an `Elbow` left or right of the line between their outer joints, seen from that of the unknown
/// named first; a link and a slider have the `Slider` far or near; the closure of a single angle has a
/// rising or falling `Slope` there. Sliders alone and linear unknowns have one solution. A singular block, and one that cannot be assembled, is named by
/// its unknowns in the error.
///
/// # Turns of angles
///
/// A group in closed form gives an angle as a direction. Its number, which tells how often it has turned, matters where
/// a wheel, a rack or a screw is driven by it, in a length, a spring or a stop, in an output, in a function of your own,
/// and in the sine of anything but a whole multiple of it. There the pose holds the number, and the branch has a turn:
/// 0 is the principal value, between -pi and pi, and n adds 2 pi n. `assemble(v, branch)` depends on its arguments alone,
/// so that a wheel behind an angle that goes through pi is put into another mesh unless the turn is counted.
/// `assemble_near` counts it: it takes the turn nearest to a guess, such as the position before. `branch_of` finds the
/// turns of a pose, and `assemble` on that branch gives the same numbers back. Two positions of different turns are
/// still on one motion: `solve` compares the signs of determinants only. Inputs keep the number that they are
/// given; an angle that a pose holds as its direction alone comes out of `coordinates()` between -pi and pi.
///
/// ```
/// linkage::linkage! {
///     /// A pin drives a slotted wheel about an axis near its own, which drives a second wheel of twice its size.
///     pub mechanism PinAndSlot {
///         param pin = 9.6, distance = 1.1;
///         input phi;
///         unknown slot, s, wheel;
///         loop pin@phi = distance@0 + s@slot;
///         equation 2 * wheel = -slot;
///         point Mark = 10@wheel;
///     }
/// }
/// let m = PinAndSlot::default();
/// let branch = PinAndSlotBranch::new(linkage::Slider::Far);
/// let mut q = m.assemble(3.10, branch)?.coordinates();
/// for step in 0..600 {
///     q.phi += 0.1;
///     q = m.assemble_near(&q, branch)?.coordinates();
/// }
/// assert!((q.phi - 63.1).abs() < 1e-12 && (q.wheel + q.phi / 2.0).abs() < 0.1);
/// assert_eq!(m.branch_of(&m.pose_at(&q)).slot_turn, 10);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// # Degenerate positions
///
/// A group can have no position at an input, one, two, or infinitely many. `assemble` says which:
///
/// - Links that do not reach each other: `PositionError::Unbuildable`, with the gap. Guides that are parallel and apart, and an
///   unknown whose factor vanishes in an equation that needs it, are unbuildable too.
/// - Links that just touch, flat at a limit: the position, whose determinant is zero; both branches meet there. A gap of
///   less than an epsilon, relative to the terms of the loop equation, counts as touching: rounding leaves no smaller one.
/// - A dyad whose outer joints coincide: with links of one length it can stand anywhere, which is
///   `PositionError::Undetermined`; with links of different lengths it is unbuildable. Joints coincide within eight epsilons of the
///   terms that they are made of. Likewise undetermined are a slotted arm whose pin is in its pivot, guides on one line, a
///   link without length, and `0 * u = 0`.
///
/// A later group can be undetermined where an earlier one is at its limit: in Peaucellier's cell the rhombus closes there.
/// `limits` gives that input nevertheless, as `Exact`, and passes inputs inside the range at which a group is undetermined,
/// such as a folded kite. `branches` leaves out a branch on which a group is undetermined, as it leaves out one that is
/// unbuildable. A limit that is `Exact` is right to two ulp, one that is `Bracketed` lies between its two inputs or within
/// three ulp of them, each times the condition number of the limit: what a relative change of every length does to it.
/// No limit is a number that is not finite.
///
/// # What is rejected
///
/// Every mistake is reported on the token that made it, all at once, with what to do about it: unknown
/// names, names used twice, unused parameters and coordinates (unless they begin with `_`), rows and
/// unknowns that do not match, closures in which nothing unknown appears, unknowns that compete for too
/// few closures, closures that are singular at every position, vectors where scalars belong and scalars
/// where vectors belong, a name used as an angle and as a modulus, a function of your own that gives too few
/// derivatives, `derive` of what is unknown or named already, bodies of negative mass or in no scene, scenes in which
/// nothing with inertia moves with an input, division by zero, constants that no `f64` holds, attributes without effect,
/// and what is too large: parentheses nested deeper than 64 levels, more than 100 000 words and signs, more than
/// 25 000 expressions, or 40 000 with their derivatives, each entry of a `sensitivity` being one (a chain of
/// four-bars takes 70 a loop). All mechanisms of an invocation share one budget of work, which is counted and not timed:
/// 345 legs of Jansen's walking machine, as many as fit into one, take three quarters of it.
///
/// ```compile_fail
/// linkage::linkage! {
///     mechanism Wrong {
///         param r = 1;
///         input phi;
///         unknown x;
///         equation x = r@phi; // a vector where a scalar belongs
///     }
/// }
/// ```
#[proc_macro]
pub fn linkage(input: TokenStream) -> TokenStream {
    // The facade's macro hands its own path over as the first token.
    let mut tokens = proc_macro2::TokenStream::from(input).into_iter();
    let root = tokens.next().into_iter().collect();
    let facade = Facade { path: root, has_dynamics: cfg!(feature = "dynamics") };
    linkage_compiler::expand_within(tokens.collect(), &facade, &Budget::default()).into()
}
