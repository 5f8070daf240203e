//! Tables of the loads of scenes: what drives must apply, frictions and stops, forces in joints.

use linkage_dynamics::simulation::Loads;
use linkage_dynamics::{Energy, Inputs, MotionErrorOf, NameOf, Power, Scene};
use linkage_runtime::kinematic::MotionOf;
use linkage_runtime::range_of_motion::{Driven, RangeOfMotion};
use linkage_runtime::{Assembly, Dim as _, Joint, JointForces, Kinematic, Mechanism, PathErrorOf, PerInput, Real};

use super::motion::{Clock, columns, on_branch, row, turn};
use super::{Cause, Quantity, Table};

impl Table {
    /// One motion of a scene over a turn of its input, in equal steps from 0 to 2 pi, both included, at a constant input
    /// rate, with the loads that a drive of the input then makes: see [`Table::over_with_loads`].
    ///
    /// ```
    /// linkage::linkage! {
    ///     /// Lengths in m, masses in kg.
    ///     pub mechanism Pump {
    ///         param r = 0.05, l = 0.15, m2 = 0.8, j2 = 1e-3, m3 = 0.9, load = 120, mu = 0.1, radius = 0.008, g = 9.81;
    ///         input phi;
    ///         unknown psi, z;
    ///         loop r@phi + l@psi = (z, 0);
    ///         point A = r@phi;
    ///         body crank { mass m2; inertia j2; center (0, 0); angle phi; }
    ///         body rod { mass m2; inertia j2; center A + (l / 2)@psi; angle psi; }
    ///         body piston { mass m3; center (z, 0); }
    ///         scene Pumping {
    ///             inertia;
    ///             gravity (0, -g);
    ///             force (-load, 0) at (z, 0);
    ///             friction mu, radius, reaction on phi;
    ///             friction mu, reaction on z;
    ///             reaction at (0, 0);
    ///             reaction at A;
    ///         }
    ///     }
    /// }
    /// use linkage::chart::{Chart, Polar};
    /// use linkage::table::Units;
    /// use linkage::{Slider, Table};
    ///
    /// let scene = Pumping::default();
    /// let table = Table::turn_with_loads(&scene, PumpBranch { psi_z: Slider::Far }, 360, 30.0)?;
    /// // The torque of the motor, and a pin force with its magnitude.
    /// let [torque, pin] = ["phi_torque", "a_on_rod"].map(|name| table.column(name).unwrap());
    /// let greatest = |numbers: &[f64]| numbers.iter().fold(0.0_f64, |most, number| most.max(number.abs()));
    /// println!("{:.1} N m, {:.0} N", greatest(torque), greatest(pin));
    /// // Without friction the motor needs less.
    /// let smooth = Table::turn_with_loads(&Pumping { mu: 0.0, ..scene }, PumpBranch { psi_z: Slider::Far }, 360, 30.0)?;
    /// let mean = |table: &Table| table.column("phi_torque").unwrap()[1..].iter().sum::<f64>();
    /// assert!(mean(&table) > mean(&smooth));
    ///
    /// let csv = table.select(["phi", "phi_torque", "a_on_rod"])?.degrees().units(Units::SI).to_csv();
    /// assert!(csv.starts_with("phi [deg],phi_torque [N m],a_on_rod [N]\n0,"));
    /// let chart = Chart::of(&table, "phi", ["phi_torque"])?.to_svg();
    /// let polar = Polar::of(&table, "a_on_rod_x", "a_on_rod_y")?.to_svg();
    /// # assert!(chart.contains("class=\"curve\"") && polar.contains("class=\"curve\""));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// A scene without `inertia;` has no loads in motion, and does not compile here:
    ///
    /// ```compile_fail,E0277
    /// # linkage::linkage! {
    /// #     mechanism Lever {
    /// #         param r = 0.1, k = 40;
    /// #         input phi;
    /// #         point P = r@phi;
    /// #         scene Static { spring k, 0 on phi; reaction at (0, 0); }
    /// #     }
    /// # }
    /// linkage::Table::turn_with_loads(&Static::default(), LeverBranch::default(), 360, 1.0);
    /// ```
    ///
    /// # Errors
    /// Those of [`Table::turn`].
    pub fn turn_with_loads<S>(
        scene: &S,
        branch: <S::Mechanism as Mechanism>::Branch,
        steps: u32,
        rate: f64,
    ) -> Result<Self, PathErrorOf<S::Mechanism>>
    where
        S: Scene<Scalar = f64, Mechanism: Kinematic + Driven<Of = <S as Scene>::Mechanism> + Assembly>,
    {
        let inputs = turn(steps);
        let range = on_branch(scene.mechanism(), branch, &inputs)?;
        Ok(Self::over_with_loads(scene, &range, inputs, rate))
    }

    /// One motion at these inputs as in [`Table::over`], with the loads of a scene if drives make this motion. The motion is
    /// that of the scene's mechanism with the same parameters.
    ///
    /// | column | number |
    /// |---|---|
    /// | `theta_torque`, `s_force` | what the drive of the input applies: a torque for an angle, a force for a length |
    /// | `drive_power` | the power of the drives |
    /// | `friction on theta`, `stop on s` | the force of a friction or a stop along its scalar |
    /// | `b_on_rod_x`, `b_on_rod_y`, `b_on_rod` | the force in a pin that a `reaction` names, and its magnitude |
    /// | `s_normal`, `s_moment` | the force and the moment in a guide |
    /// | `kinetic_energy`, `potential_energy` | the energy of a scene with `energy;` |
    /// | `applied_power`, `dissipated_power` | in a simulation, the power of a scene with `power;` |
    ///
    /// A friction that depends on a force in a joint acts as [`Scene::loads`] has it. The time of the scene is that of the
    /// column `time`, or 0; its own drives do not act. Where loads do not exist, as at a dead point, their cells are
    /// empty.
    #[must_use]
    pub fn over_with_loads<S, M>(
        scene: &S,
        range: &RangeOfMotion<'_, M>,
        inputs: impl IntoIterator<Item = f64>,
        rate: f64,
    ) -> Self
    where
        S: Scene<Scalar = f64, Mechanism: Kinematic>,
        M: Driven<Scalar = f64, Of = S::Mechanism>,
    {
        let mut clock = Clock::new(rate);
        let mut rows = Vec::new();
        let (mut names, mut has_energy) = (None, false);
        for input in inputs {
            let (mut row, motion) = row(range, input, &mut clock);
            let cause = match motion {
                Err(error) => Some(Cause::Path(error)),
                Ok(motion) => {
                    let t = clock.at(input).unwrap_or_default();
                    names = names.take().or_else(|| contact_names(scene, t, &motion.position, &motion.rates));
                    let loads = loads_and_energy(scene, t, &motion).map(|(loads, energy)| {
                        has_energy |= energy.is_some();
                        row.extend(numbers(scene, &loads, |_| true).into_iter().chain(of_energy(energy)));
                    });
                    loads.err().map(Cause::of_motion)
                }
            };
            rows.push((row, cause));
        }
        let loads = load_columns(scene, names.as_deref(), |_| true).into_iter().chain(energy_columns(has_energy));
        let mut table = Self::of_columns(columns(range.mechanism(), rate).into_iter().chain(loads));
        for (row, cause) in rows {
            table.push_partial(&row, cause);
        }
        table.mark_motion(range);
        table
    }
}

/// Loads, and the energy if the scene has it.
type LoadsAndEnergy<S> = (Loads<S>, Option<Energy<f64>>);

/// The loads if drives make this motion, and the energy.
fn loads_and_energy<S>(
    scene: &S,
    t: f64,
    motion: &MotionOf<S::Mechanism>,
) -> Result<LoadsAndEnergy<S>, MotionErrorOf<S>>
where
    S: Scene<Scalar = f64, Mechanism: Kinematic>,
{
    let (_, rates) = S::Mechanism::rate_parts(&motion.rates);
    let (_, accelerations) = S::Mechanism::acceleration_parts(&motion.accelerations);
    let (rates, accelerations) = (Inputs::<S>::from(rates), Inputs::<S>::from(accelerations));
    let energy = scene.kinetic_and_potential(&motion.position, &rates)?;
    Ok((scene.loads_of_motion(t, &motion.position, rates, accelerations)?, energy))
}

/// The numbers of an energy, if there is one.
pub(super) fn of_energy(energy: Option<Energy<f64>>) -> impl Iterator<Item = f64> {
    energy.into_iter().flat_map(|Energy { kinetic, potential }| [kinetic, potential])
}

/// The numbers of a power, if there is one.
pub(super) fn of_power(power: Option<Power<f64>>) -> impl Iterator<Item = f64> {
    power.into_iter().flat_map(|Power { applied, dissipated }| [applied, dissipated])
}

/// The names of frictions and stops; none where they cannot be evaluated.
pub(super) fn contact_names<S: Scene>(
    scene: &S,
    t: S::Scalar,
    q: &linkage_dynamics::Coordinates<S>,
    rates: &linkage_dynamics::Rates<S>,
) -> Option<Vec<NameOf<S>>> {
    Some(scene.contacts(t, q, rates).ok()?.iter().map(|contact| contact.name).collect())
}

/// The columns of the loads, with the forces of these drives.
pub(super) fn load_columns<S: Scene>(
    scene: &S,
    contacts: Option<&[NameOf<S>]>,
    is_driven: impl Fn(usize) -> bool,
) -> Vec<(String, Quantity)> {
    let (mut all, mechanism) = (Vec::new(), scene.mechanism());
    for (input, &is_angle) in mechanism.input_angles().iter().enumerate() {
        if is_driven(input) {
            let name = mechanism.input_name(input);
            let (end, quantity) = if is_angle { ("torque", Quantity::Torque) } else { ("force", Quantity::Force) };
            all.push((format!("{name}_{end}"), quantity));
        }
    }
    if !all.is_empty() {
        all.push(("drive_power".to_owned(), Quantity::Power));
    }
    for place in 0..scene.contact_count().count() {
        let name = contacts.and_then(|names| names.get(place));
        all.push((name.map_or_else(|| format!("contact {}", place + 1), |name| name.to_string()), Quantity::Plain));
    }
    for joint in scene.joints() {
        match joint {
            Joint::Pin { name, .. } => {
                all.extend(["_x", "_y", ""].map(|end| (format!("{name}{end}"), Quantity::Force)));
            }
            Joint::Guide { name, .. } => {
                all.push((format!("{name}_normal"), Quantity::Force));
                all.push((format!("{name}_moment"), Quantity::Torque));
            }
        }
    }
    all
}

/// The columns of the energy, if the scene has it.
pub(super) fn energy_columns(has_energy: bool) -> impl Iterator<Item = (String, Quantity)> {
    let names = if has_energy { &["kinetic_energy", "potential_energy"][..] } else { &[] };
    names.iter().map(|name| ((*name).to_owned(), Quantity::Torque))
}

/// The columns of the power of a scene at a state, if the scene has it.
pub(super) fn power_columns(has_power: bool) -> impl Iterator<Item = (String, Quantity)> {
    let names = if has_power { &["applied_power", "dissipated_power"][..] } else { &[] };
    names.iter().map(|name| ((*name).to_owned(), Quantity::Power))
}

/// The numbers of the loads in the order of their columns.
pub(super) fn numbers<S: Scene<Scalar = f64>>(
    scene: &S,
    loads: &Loads<S>,
    is_driven: impl Fn(usize) -> bool,
) -> Vec<f64> {
    let drives: PerInput<S::Mechanism> = loads.drives.into();
    let mut all: Vec<f64> =
        drives.iter().enumerate().filter(|(input, _)| is_driven(*input)).map(|(_, force)| *force).collect();
    if !all.is_empty() {
        all.push(loads.drive_power);
    }
    all.extend(loads.contacts.iter());
    for (joint, [first, second]) in scene.joints().zip(loads.joints.each()) {
        all.extend([first, second]);
        all.extend(matches!(joint, Joint::Pin { .. }).then(|| Real::hypotenuse(first, second)));
    }
    all
}
