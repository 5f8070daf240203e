//! The `linkage!` macro: compiles the loop equations of a mechanism to specialised Rust.
//!
//! Use it through the `linkage` crate. The documentation of [`linkage!`] is the manual of the language.

#![warn(missing_docs)]

use linkage_compiler::Facade;
use linkage_compiler::budget::Budget;
use proc_macro::TokenStream;

/// Defines mechanisms by their loop equations.
///
/// The macro differentiates the equations symbolically at compile time and emits functions for the
/// constraint Jacobian, the velocity ratios, velocities, accelerations, points and outputs.
///
/// # A mechanism
///
/// ```
/// use linkage::linkage;
///
/// linkage! {
///     /// Four-bar linkage; the loop is A-B-C-D with l4 from C to D.
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
/// // C to the left of the line from B to D; the crank at 20 degrees turns at 400 rpm.
/// let branch = FourBarBranch::new(linkage::Elbow::Left);
/// let motion = four_bar.full_kinematics(20_f64.to_radians(), branch, 41.9, 0.0)?;
/// assert!((motion.rates.theta3 + 18.4).abs() < 0.1);
/// assert!(motion.points.g3.position.y > 30.0);
/// // Functions of a position take its pose.
/// assert!((four_bar.velocity_ratios(&motion.pose)?[0] + 0.4399).abs() < 1e-4);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// `mechanism NAME { statements }`: attributes, doc comments and visibility go to the type of the
/// parameters. One invocation may define several mechanisms; it may be placed in a module, a function
/// body or a test. Statements may come in any order, except that an expression uses only the `let`s,
/// `point`s and `output`s above it. Doc comments on a statement become those of the fields it declares.
///
/// Attributes are forwarded as follows; in other places they are an error:
///
/// | on | effect |
/// |---|---|
/// | `mechanism` | `cfg`, `allow`, `warn`, `deny` and `forbid` apply to every emitted item; all others, such as `derive`, go to the types that hold parameters |
/// | `drive`, `scene` | all go to its type |
/// | `param` | all go to its field, such as `#[serde(rename = "…")]` |
/// | `input`, `unknown`, `coordinate`, `point`, `output`, `loop`, `equation`, `extern fn` | doc comments go to the emitted documentation |
/// | `let`, `derive`, `body`, effects | doc comments only; they are not emitted |
///
/// `cfg` on a part of a mechanism is an error, since macros run before it is evaluated: write one mechanism for each
/// case. The macro also checks a mechanism that `cfg` removes. `deprecated` is an error, since the emitted code would
/// trigger it.
///
/// | statement | meaning |
/// |---|---|
/// | `param a = 1, b;` | geometric and physical data; a default is a number. If all have defaults, the type implements `Default` |
/// | `input v;` | independent coordinates, one for each degree of freedom |
/// | `unknown u;` | dependent coordinates, as many as scalar equations (two for each `loop`, one for each `equation`) |
/// | `loop VECTOR = VECTOR;` | a vector loop equation, that is two scalar equations; the right side may be `0` |
/// | `equation SCALAR = SCALAR;` | a scalar constraint: gears, rolling, cams, loops by component |
/// | `implied loop VECTOR = VECTOR;`, `implied equation SCALAR = SCALAR;` | a loop or an equation that follows from the others, such as the second loop of a parallelogram on three cranks: it is no constraint, but is checked at each position, see below |
/// | `let NAME = EXPRESSION;` | a named subexpression, scalar or vector |
/// | `point NAME = VECTOR;` | a point; functions for its position, velocity and acceleration are emitted |
/// | `output NAME = SCALAR;` | a scalar quantity; functions for its value, rate and acceleration are emitted |
/// | `extern fn PATH(x, p) -> (f, df, ddf);` | a user function with its derivatives, see below |
/// | `coordinate q;` and `drive NAME by q;` | a mechanism with several choices of input, see below |
/// | `derive jerk, sensitivity;` | higher derivatives and sensitivities, see below |
/// | `body NAME { mass m; inertia j; center G; angle phi; }` | a rigid body, see below |
/// | `scene NAME { inertia; gravity (0, -g); }` | the mechanism with forces, see below |
///
/// Field names are converted to snake case: the point `G3` becomes the field `g3`.
///
/// # Expressions
///
/// | form | meaning |
/// |---|---|
/// | `r@phi` | the vector of modulus `r` at the angle `phi`: (r cos phi, r sin phi) |
/// | `(x, y)` | a vector by components |
/// | `(x, y)@phi` | the local vector (x, y) rotated by `phi` |
/// | `+ - * /`, unary `-` | as usual; vector plus vector, scalar times vector |
/// | `x^n`, `powi(x, n)`, `x.powi(n)` | integer powers |
/// | `sin cos tan asin acos atan atan2 sqrt abs exp ln hypot` | scalar functions; `x.sqrt()` is `sqrt(x)` |
/// | `x(P) y(P) norm(V) angle(V) dot(A, B) cross(A, B)` | functions of vectors |
/// | `f(x, p)` | a user function or one of its derivatives, under the name that `extern fn` gives it |
/// | `pi`, `20deg`, `1.5`, `3` | constants; integers, decimals and their ratios stay exact |
///
/// A constant must be zero or a normal `f64`, 2.3e-308 to 1.7e308 in magnitude, also if it is computed from others or
/// arises in a derivative; otherwise the macro reports an error. Other scalars convert it from `f64`: in `f32` it
/// becomes infinite above 3.4e38, which functions that return a `Result` report as `NotFinite`, and zero below 7e-46.
///
/// `@` binds tighter than `+ -` and looser than `* /`, so `l3/2 @ phi + s @ (phi - delta)` needs no
/// further parentheses. Angles are in radians. The macro infers from its use if a name is an angle or a length,
/// and says so in the documentation of its field.
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
/// // J is singular where z2 + z3 cos(delta) = 0: equation 1.1 of the lecture notes that the README cites.
/// assert!((arm.determinant(&pose) + q.z2 + 0.25).abs() < 1e-15);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// A scalar constraint without a loop:
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
/// # User functions
///
/// A cam law or a table is a generic function that returns its value and its derivatives with respect to the first
/// argument:
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
/// The function at the path takes one `T` for each argument and returns a tuple with one `T` for each name after `->`:
/// its value and its first, second, ... derivative with respect to the first argument. Each name is a function in
/// expressions. The other arguments are held constant: expressions there must not depend on coordinates. Velocities and
/// accelerations take two derivatives more than the highest that a loop equation, point or output names; an error says
/// if the function returns fewer.
///
/// The function is called once for each distinct argument list, for all derivatives together, and a pose (a position
/// prepared for further functions, see below) stores the values. Return NaN where the function is undefined: this
/// becomes the error `NotFinite`. The first argument may depend on an unknown; the unknown is then found by Newton's
/// method, and `assemble_near` replaces `assemble`.
///
/// # Choice of the driving coordinate
///
/// The singular configurations of a mechanism depend on the coordinate that drives it. A mechanism may leave the choice
/// of input open: each `drive` defines a type with the same parameters, a driver. All drivers share the type of the
/// coordinates, so that a position found with one can be used with the others.
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
/// # Higher derivatives and sensitivities
///
/// A `derive` statement adds functions for every driver; q, u, v, Psi, J, A and W are defined
/// [below](#what-is-emitted-for-mechanism-fourbar). Linear systems in J are solved as in `velocity`:
///
/// | keyword | functions |
/// |---|---|
/// | `limits` | `limits(v, branch)`, or `limits_of_NAME` for each of several inputs: the interval of the input about a position in which the mechanism can be assembled. Limits of groups that depend on the inputs alone, directly or through linear equations, are in closed form; those of other groups are bracketed by search. Isolated inputs at which a group has infinitely many positions do not end the interval |
/// | `jerk` | `jerk(&pose, &q', &q'', v''')` from J u''' = -(A v''' + eta), where eta are the terms without third derivatives, for any number of inputs; `point_jerks`, `output_jerks` |
/// | `velocity_ratio_derivatives` | `velocity_ratio_derivatives(&pose)`: d2u/dv dv, for each unknown a symmetric matrix L with u'' = W v'' + v' . L v' (velocity coefficients and their derivatives in S. Doughty, "Mechanics of Machines"); `point_ratio_derivatives`, `output_ratio_derivatives` |
/// | `sensitivity` | `sensitivity(&pose)`: du/dp = -J^-1 `Psi_p` at fixed inputs, one column for each parameter; `point_sensitivities`, `output_sensitivities`: the total derivatives dl/dp = `l_p` + `l_u` du/dp |
/// | `drawing` | the joints and parts of a drawing, guessed from the vectors of loops and points (the trait `Skeleton`): `Animation::turn(&mechanism, branch)` and `Drawing::of(&mechanism, &pose)` of the module `drawing` then need no more |
/// | `serde` | with the feature `serde`: `Serialize` and `Deserialize` of parameters, coordinates, rates, accelerations, inputs, points, outputs, motion and branch, with your names as fields |
/// | `lanes` | `batch(design, v, branch, v', v'')`: many positions at once, from columns or single numbers; `NAMEColumns` names the columns to find, and `Batch::run` fills them with the bits of `kinematics` and `full_kinematics`. Groups without closed form, user functions, and the functions tan, asin, acos, atan, exp and ln are computed one position after the other |
///
/// ```
/// linkage::linkage! {
///     /// A slider-crank: sensitivity to the rod's length, and jerk of the piston.
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
/// // At the dead centre: x = r + l = 4, dx/dr = dx/dl = 1, and the output x - l does not depend on l.
/// assert_eq!(piston.sensitivity(&pose)?.row(1).iter().copied().collect::<Vec<f64>>(), [1.0, 1.0]);
/// assert_eq!(piston.output_sensitivities(&pose)?.stroke[1], 0.0);
/// // d2x/dphi2 = -r (1 + r/l).
/// let [_, x] = piston.velocity_ratio_derivatives(&pose)?;
/// assert!((x[(0, 0)] + 4.0 / 3.0).abs() < 1e-14);
/// // x is even in phi, so that its jerk at constant speed is zero at phi = 0.
/// let rates = piston.velocity(&pose, 1.0)?;
/// let accelerations = piston.acceleration(&pose, &rates, 0.0)?;
/// assert!(piston.jerk(&pose, &rates, &accelerations, 0.0)?.x.abs() < 1e-14);
/// // With a rod half as long as the crank, the crank turns at most 30 degrees from the line of the slider.
/// let short = Piston::new(2.0, 1.0);
/// let limits = short.limits(0.1, PistonBranch { psi_x: linkage::Slider::Far })?;
/// assert!((limits.upper.input().unwrap() - std::f64::consts::FRAC_PI_6).abs() < 1e-15);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// # Scenes: dynamics
///
/// A mechanism alone is kinematics. A `scene` adds forces and inertia. It is a type that holds the mechanism and the
/// parameters of its effects. An effect that the scene does not name adds no field, no code and no run time
/// (`cargo bench --bench effects` prints the operations and the time of each). All parameters are declared with
/// `param`; one that appears in no loop equation, point or output becomes a field of the scenes that use it, not of the
/// mechanism.
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
///         /// Inverse dynamics: the torque that turns the crank at constant speed.
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
/// // For an integrator: the state y = (q, v') and its derivative y' = (q', v'').
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
/// | `inertia;` | the inertia of all bodies; `inertia crank, rod;` that of the bodies named. Without it the scene is static |
/// | `gravity (0, -g);` | the weight of all bodies; `gravity (0, -g) on rod;` that of the bodies named |
/// | `spring k, s0 between P and Q;` | a linear spring: stiffness, and free length, which is zero if omitted |
/// | `spring k, phi0 on phi;` | a spring on any scalar: coordinate, output or expression |
/// | `damper c between P and Q;`, `damper c on phi;` | the force -c s' along the distance or scalar s; c may be a LAW |
/// | `torque LAW on phi;` | a torque on an angle, or a force on a length: its work is LAW times the change of `phi` |
/// | `force (fx, fy) at P;` | a force at a point |
/// | `potential V;` | the forces -dV/dq of any potential energy V |
/// | `friction mu, radius, normal on phi;` | dry friction in a joint: its largest torque is the product mu radius normal; each factor may be a LAW |
/// | `friction mu, normal on s;` | dry friction along a length: its largest force is mu normal |
/// | `stop s in lower..upper, restitution e;` | lower <= s <= upper; at an impact s'+ = -e s'- |
/// | `drive v = LAW;` | a prescribed input; the force that drives it is found by inverse dynamics |
/// | `energy;`, `power;`, `reactions;`, `equilibrium;` | further functions, see the next table |
///
/// A LAW is an expression of parameters, coordinates, outputs, their rates as `rate(x)`, and time `t`; that of a
/// `drive` depends on time and parameters only. In a mechanism with several drivers a scene names its driver:
/// `scene Fired of Engine { … }`.
///
/// | item of a scene | meaning |
/// |---|---|
/// | `mechanism`, `new`, `Default`, `map`, conversion from the mechanism and an array | the kinematics, and the parameters of the effects |
/// | `mass_matrix(&q)` | M = sum m `W_G`' `W_G` + j `W_phi`' `W_phi`, with the velocity ratios of the centres and angles of the bodies; with `inertia` |
/// | `forces(t, &q, v')` | the generalised forces Q, including the quadratic velocity terms: M v'' = Q |
/// | `acceleration(t, &q, v')`, `rates(t, &q, v')` | v''; the pair (q', v''); with `inertia` |
/// | `drives(t)`, `drive_forces(t, &q, v')` | value, rate and acceleration of each prescribed input; the forces that drive them, M v'' - Q |
/// | `DERIVATION` | the equations of motion as data: M, the contribution of each body and effect to Q, the potential energy; `sheet` prints them |
/// | `energy(&q, v')`, `power(t, &q, v')` | kinetic and potential energy; applied power (of forces, torques and drives) and dissipated power (of dampers and frictions) |
/// | `reactions(t, &q, v')` | the Lagrange multipliers: for a `loop` as written, the force of its left side on its right side where it is cut |
/// | `equilibrium(t, &guess)` | the position of static equilibrium near the guess, by Newton's method, with prescribed inputs at their values; `balance(t, &q)`: the forces at rest and their derivatives, whose signs decide stability |
/// | `check()` | returns an error that names the parameter if a mass, an inertia or a friction is negative, the range of a stop is empty, or a restitution is not between 0 and 1 |
/// | `unreduced(t, &q, &q')` | with `inertia`: M and F of `M q'' + Psi_q' lambda = F` in all coordinates, without frictions and stops |
/// | the trait `Scene` | with `inertia`: the state (q, v') for an integrator, its derivative, its projection onto the constraints; `contacts`: each friction and stop with its scalar and its limits; `equations`: M, Q, W, and u'' at v'' = 0, without frictions and stops |
///
/// ## Simulation
///
/// `simulation::simulate` integrates a scene with `inertia`, also one with frictions and stops, and returns states with
/// all coordinates and rates by name. At dead points of the input it continues in other independent coordinates; at
/// change points, where motions cross, on the one whose tangent continues. Where it cannot continue it returns an
/// error; earlier states remain valid.
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
/// // (t, a guess of the position, z'); the end time; the relative tolerance of a step.
/// let mut motion = simulate(&scene, (0.0, start, -1.0), 1.0, 1e-9)?;
/// for state in motion.at([0.25, 0.5, 0.75, 1.0]) {
///     let state = state?;
///     println!("{:4} s: {:8.5} rad, {:8.5} rad/s", state.t, state.q.phi, state.rates.phi);
/// }
/// // It passes both dead points of the input z in every turn.
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
/// The types `Path` and `Simulation` have only the mechanism or the scene as type parameters, so that they can be
/// fields of your own structs. Generic functions take `M: Mechanism` and `S: Scene`.
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
/// /// The largest residual of the loop equations of any mechanism.
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
/// Frictions and stops act on a coordinate, an output or any other scalar that moves. Their forces are discontinuous:
/// a joint sticks or slips, a stop is open or closed. Therefore `forces`, `acceleration`, `drive_forces`, `reactions`,
/// `equilibrium` and the trait method `Scene::derivative` are computed **without** them. `contacts` lists them, and the
/// module `contact` finds the modes of a state, the accelerations and forces in these modes, the events that end them,
/// and the changes at an event. `simulate` does all of this: each state reports the mode of every friction and stop,
/// and the changes since the previous state.
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
/// // A torque of 0.5 N m does not overcome the friction: the press sticks.
/// let (contacts, rates) = Contacts::begin(0.0, &rates.into(), at)?;
/// assert_eq!(contacts.modes, [Mode::Stick, Mode::Stick, Mode::Open]);
/// assert_eq!(contacts.motion(&at(&rates)?)?.acceleration[0], 0.0);
///
/// // Ten times this torque moves it.
/// let press = Working { torque: 5.0, ..press };
/// let at = |v: &Column<f64, D<1>>| ReducedEquations::of(&press, 0.0, &Working::state(&q, &(*v).into()));
/// let (contacts, rates) = Contacts::begin(0.0, &rates, at)?;
/// assert_eq!(contacts.modes, [Mode::SlipForward, Mode::SlipBackward, Mode::Open]);
/// assert!(contacts.motion(&at(&rates)?)?.acceleration[0] > 50.0);
///
/// // The ram moves to its stop, bounces, and comes to rest on it.
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
/// // The torque of the stop on the crank: its force times the velocity ratio dz/dphi.
/// let ratio = press.mechanism.motion(&end.q, 1.0, 0.0)?.rates.z;
/// println!("{:.1} N m", motion.loads()?.contacts[2] * ratio);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// - A sticking contact transmits a force up to its limit. Several contacts of a mechanism with one input v stick while
///   |Q| does not exceed the sum of limit |ds/dv| over them. Static and kinetic limit are equal unless the limit is a
///   LAW that depends on `rate(s)`.
/// - At an impact s'+ = -e s'-, and no other stop in contact is penetrated. Impulses of friction are neglected.
/// - Bouncing ends when the rebound rate is less than sqrt(epsilon) times the largest impact rate of the series, or the
///   rebound is not higher than one ulp of s.
/// - The touch of a stop is found even if it is brief within a step of the integration, provided that the gap has one
///   minimum in the step. Changes between stick and slip, and your own events, are found if the function whose zero
///   they are has one extremum in a step. With more, some are missed: for random sums of sines 0.1 % with two extrema
///   in a step, 1 % with three, 5 % with four, 25 % with five. See the module `integrate`; `largest_step` reduces these
///   rates.
/// - A body at rest on a stop without load stays there, and so do two bodies after an impact without rebound.
/// - A simulation of frictions or stops backwards in time returns `MotionError::Irreversible`.
/// - `power` counts limit |s'| of each friction as dissipated. In scenes with contacts it omits the power of drives,
///   which depends on the modes; `loads` of a simulation has it, with the forces of frictions, stops and drives.
///
/// Each function of a scene computes sines, cosines and common subexpressions once. Its coordinates must satisfy the
/// loop equations; angles may exceed a turn.
///
/// # What is emitted for `mechanism FourBar`
///
/// q are all coordinates, v the inputs, u the unknowns, Psi(q) = 0 the loop equations and constraints, J = `Psi_u`,
/// A = `Psi_v`, W = -J^-1 A and gamma = `(Psi_q q')_q q'`, so that u' = W v' and J u'' = -(A v'' + gamma).
///
/// | item | meaning |
/// |---|---|
/// | `FourBar<T = f64>` | the parameters; `new` (up to seven parameters), `Default` for `f64`, `map` to another scalar, conversions from and to arrays |
/// | `FourBarCoordinates<T>`, `FourBarRates<T>`, `FourBarAccelerations<T>` | q, q' and q'' by name, with `derive jerk` also `FourBarJerks<T>`, q'''; u before v; conversions from and to `SVector` |
/// | `FourBarInputs<T>` | v by name, also used for v' and v''; a single input converts from a number, and all from q, q' or q'' |
/// | `FourBarPoints<Q>`, `FourBarOutputs<Q>` | a quantity `Q`, such as a velocity, for each point or output by name |
/// | `kinematics(v, branch, v', v'')` | position, velocity and acceleration in one computation from the inputs: `FourBarKinematics<T>` with `pose`, `rates` and `accelerations`. It is the fastest way: links are solved once for all three, and no angle is computed that nothing reads |
/// | `full_kinematics(v, branch, v', v'')` | the same with `points` and `outputs`: `FourBarFullKinematics<T>`; emitted if points or outputs are declared |
/// | `kinematics_near(&guess, branch, v', v'')`, `full_kinematics_near` | replace these two if some blocks have no closed form, see `assemble_near` |
/// | `motion(&q, v', v'')` | the same at given coordinates of a position: `FourBarMotion<T>` with `position`, `rates`, `accelerations`, `points` and `outputs` |
/// | `assemble(v, branch)` | position in closed form, group by group, on the given branch. If a block has no closed form, it is marked as deprecated, and the note and the documentation of the type say which block and why |
/// | `assemble_near(&guess, branch)` | if some blocks have no closed form: takes the place of `assemble`, with Newton's method from the guess for these blocks. If turns of angles matter (see below): in addition to `assemble`, with each angle in the turn nearest to the guess |
/// | `branches(v)` | every position that exists at these inputs, with its branch, `for found in four_bar.branches(v)? { .. }`; angles at their principal values; branches on which a group is undetermined are omitted |
/// | `FourBarBranch`, `branch_of(&pose)` | the branch, that is the assembly mode: one of two solutions for each group, by the names of its unknowns, and the turns of angles, see below; `new(..)` sets all turns to 0, `all()` lists the branches with turns 0 |
/// | `branch_near(&rough)` | the branch of a rough position, such as one read off a drawing |
/// | `solve(&guess)` | position by Newton's method on the branch of the guess, with its iterations and residual |
/// | `solve_any_branch(&guess)` | position by Newton's method on any branch, with a flag that is true on the branch of the guess |
/// | `FourBarPose<T>`, `pose_at(&q)` | a position prepared for the functions below, which then compute no sines: directions of angles, determinants, inputs and angles as numbers where needed, values of user functions; `coordinates()` converts it back |
/// | `velocity(&pose, v')`, `acceleration(&pose, &q', v'')` | q' and q'' |
/// | `points(&pose)`, `point_velocities(&pose, &q')`, `point_accelerations(&pose, &q', &q'')` | positions, velocities and accelerations of all points |
/// | `outputs(&pose)`, `output_velocities(&pose, &q')`, `output_accelerations(&pose, &q', &q'')` | values, rates and accelerations of all outputs |
/// | `velocity_ratios`, `point_ratios`, `output_ratios` | W; for each point and output l, W_l with l' = W_l v' |
/// | `residual`, `residual_scales` | Psi; for each row, the sum of the magnitudes of its terms |
/// | `jacobian`, `jacobian_unknowns`, `jacobian_inputs` | `Psi_q`, J and A |
/// | `determinant`, `block_determinants` | det J; the determinants of its blocks in the order of solution |
/// | `gamma(&pose, &q')`, `solve_jacobian(&pose, &r)` | the quadratic velocity term; J^-1 r |
/// | `limits`, `jerk`, `velocity_ratio_derivatives`, `sensitivity` and those of points and outputs, `joints`, `batch` | with a `derive` statement |
/// | `DERIVATION` | the derivation as data: every formula as Unicode text, LaTeX and MathML, the order of solution with the closed form of each block, the operations of each function; `sheet` prints it as a document |
///
/// These functions return `PositionError`. `T` is any real scalar: `f32`, `f64`, dual numbers. Emitted code allocates
/// nothing, cannot panic and does not need the standard library.
///
/// The equations are solved block by block: unknowns that depend on one another form a block. A block of one or two
/// unknowns has a formula, a larger one a factorisation. Dyads (Assur groups of class II) are recognised by the way
/// their unknowns enter the loop equation (RRR, RRP, RPR, two sliders) and named in the emitted documentation and in
/// `DERIVATION`. Dyads, single angles and linear unknowns have closed-form positions. An RRR dyad has an `Elbow` left
/// or right of the line between its outer joints, seen from that of the unknown named first; a link with a slider has
/// the `Slider` far or near, however its guide lies; a single angle has a rising or falling `Slope` of its equation. Two
/// sliders and linear unknowns have one solution. An error names a singular block, or one that cannot be assembled, by its
/// unknowns, a dyad also by its joints.
///
/// A dyad may be written in several ways. An angle may be measured against the sense of rotation, `c@(pi - theta)`. The
/// coordinates of a joint may be unknowns, as the end of one loop and the beginning of the next: an unknown with a
/// number as its factor is eliminated from the other equations of its block, and `residual` has the equations that
/// result; reactions are those of the loops as written. A joint may be given by its distances, `norm((x, y) - A) = b`,
/// or by their squares: its `Elbow` is seen from the centre in the first equation to that in the second, (x, y) in the
/// order of declaration. A negative distance is unbuildable, a negative length in a square counts as positive.
///
/// ```
/// # use linkage::{Elbow, linkage};
/// linkage! {
///     pub mechanism Distances {
///         param a = 20, b = 50, c = 70, d = 80;
///         input theta;
///         unknown x, y;
///
///         equation norm((x, y) - a@theta) = b;
///         equation norm((x, y) - (d, 0)) = c;
///         /// The foot of a brace that is as long as the rocker.
///         implied equation (x - d)^2 + y^2 = c^2;
///
///         point C = (x, y);
///     }
/// }
///
/// let m = Distances::default();
/// let pose = m.assemble(1.2, DistancesBranch::new(Elbow::Left))?;
/// assert!((pose.x - 39.341).abs() < 1e-3 && (pose.y - 56.981).abs() < 1e-3);
/// # Ok::<(), linkage::Error>(())
/// ```
///
/// Loops that follow from the others are declared as `implied`. `assemble`, `kinematics`, `solve`, each step of a `Path`
/// and `check_implied(&pose)` return `PositionError::NotImplied` if one does not close: its residual is more than
/// 16 sqrt(epsilon), the accuracy of a position at a dead point, times the sum of the magnitudes of its terms. `branches`
/// omits such branches.
///
/// # Turns of angles
///
/// The closed form of a group yields the direction (cos, sin) of an angle, not its number of turns. The angle itself
/// matters where it drives a wheel, a rack or a screw, in a length, a spring or a stop, in an output, in a user
/// function, and in the sine of anything but an integer multiple of it. In these cases the pose stores the angle as a
/// number, and the branch has a field for its turn: 0 is the principal value, between -pi and pi, and n adds 2 pi n.
/// `assemble(v, branch)` does not count turns: when an angle passes pi with the same branch, a wheel that it drives
/// jumps. `assemble_near` uses the turn nearest to a guess, such as the previous position. `branch_of` returns the
/// turns of a pose, and `assemble` on that branch reproduces its angles. Positions that differ by turns are on the same
/// branch of the motion: `solve` compares only the signs of determinants. Inputs are returned as given; `coordinates()`
/// returns angles that the pose stores as directions between -pi and pi.
///
/// ```
/// linkage::linkage! {
///     /// A pin on a crank drives a slotted wheel, which drives a second wheel of twice its size.
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
/// A group can have no position at an input, one, two, or infinitely many:
///
/// - Links that do not reach each other: `assemble` returns `PositionError::Unbuildable` with the gap. It does so too
///   for guides that are parallel and apart, and for a linear unknown whose coefficient vanishes.
/// - Links stretched or folded in line at a limit: `assemble` returns the position, whose determinant is zero; both
///   branches meet there. A gap of at most one epsilon times the sum of the magnitudes of the terms of the loop
///   equation counts as zero, since rounding errors are of this size.
/// - A dyad whose outer joints coincide: with links of equal length its position is arbitrary, and `assemble` returns
///   `PositionError::Undetermined`; with links of different lengths it is unbuildable. Joints coincide if their
///   distance is at most eight epsilons times the sum of the magnitudes of the terms of their coordinates. Also
///   undetermined are a slotted arm whose pin is in its pivot, guides on one line, a link of zero length, and
///   `0 * u = 0`.
///
/// A group can be undetermined where a group solved before it is at its limit: in Peaucellier's cell the rhombus folds
/// there. `limits` returns that input all the same, as `Exact`, and ignores inputs inside the range at which a group is
/// undetermined, such as a folded kite. `branches` omits branches on which a group is undetermined or unbuildable. An
/// `Exact` limit is accurate to two ulp; a `Bracketed` limit lies between its two inputs or within three ulp of them;
/// both times the condition number of the limit v, 1 + the sum of |(l / v) dv/dl| over the lengths l. All limits are
/// finite numbers.
///
/// # Compile errors
///
/// The macro reports all mistakes at once, each on its token and with a remedy: unknown names, names used twice,
/// unused parameters and coordinates (unless they begin with `_`), numbers of equations and unknowns that differ,
/// equations without unknowns, more equations for some unknowns than there are of these, equations that are
/// singular at every position, vectors where scalars belong and scalars where vectors belong, a name used as an angle
/// and as a length, a user function that returns too few derivatives, unknown or repeated keywords after `derive`,
/// bodies of negative mass or in no scene, scenes in which no inertia moves with an input, division by zero,
/// constants outside the range of `f64`, and attributes without effect. The size is limited: to 64 levels of
/// parentheses, 100 000 tokens, 25 000 expressions, and 40 000 with their derivatives, including one for
/// each entry of `sensitivity` (a chain of four-bars takes 70 for each loop). All mechanisms of an invocation share one
/// budget of work, which is counted, not timed: 345 legs of Jansen's walking machine, as many as 100 000 tokens define,
/// take three quarters of it.
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
    // The macro of the facade passes its own path as the first token.
    let mut tokens = proc_macro2::TokenStream::from(input).into_iter();
    let root = tokens.next().into_iter().collect();
    let facade = Facade { path: root, has_dynamics: cfg!(feature = "dynamics"), has_serde: cfg!(feature = "serde") };
    linkage_compiler::expand_within(tokens.collect(), &facade, &Budget::default()).into()
}
