//! The functions of the traits, positions by Newton's method and along a line, and their singularity.

use linkage::continuation::{Along, AlongCoordinates, Direction, Line, Path};
use linkage::kinematic::Quantity;
use linkage::position::{newton, newton_any_branch};
use linkage::{Assembly, Branches, Build, Column, D, Dim, Kinematic, Matrix, Mechanism, PerInput, singularity};
use linkage_gallery::Fixture;

use super::{Numbers, Positions, at_run_time, bit, bits, coordinates, position, same};

fn rates<M: Mechanism<Scalar = f64>>(rates: &M::Rates) -> String {
    let (unknowns, inputs) = M::rate_parts(rates);
    bits(unknowns.iter().chain(&inputs))
}

fn accelerations<M: Kinematic<Scalar = f64>>(accelerations: &M::Accelerations) -> String {
    let (unknowns, inputs) = M::acceleration_parts(accelerations);
    bits(unknowns.iter().chain(&inputs))
}

fn matrix<R: Dim, C: Dim>(matrix: &Matrix<f64, R, C>) -> String {
    let (rows, columns) = matrix.dims();
    let entries = (0..rows.count()).flat_map(|row| (0..columns.count()).map(move |column| bit(matrix[(row, column)])));
    format!("{}x{} {}", rows.count(), columns.count(), entries.collect::<Vec<_>>().join(" "))
}

/// The result by its numbers, or the words of its error.
fn found<X, E: ToString>(result: Result<X, E>, of: impl FnOnce(X) -> String) -> String {
    result.map_or_else(|error| error.to_string(), of)
}

/// A quantity of points and outputs as the debug text of its numbers, which round-trip.
fn list<Q: Quantity, N: Dim>(all: Column<Q, N>) -> String {
    format!("{:?}", all.as_slice())
}

/// All that the traits compute at a position.
fn functions<M: Kinematic<Scalar = f64>>(m: &M, at: &Numbers) -> Vec<String> {
    let q = coordinates::<M>(at);
    let pose = m.pose_at(&q);
    let given = |value: f64| -> PerInput<M> { m.dims().1.repeat(value) };
    let mut all = vec![
        format!("{}", M::is_finite(&pose)),
        bits(&m.residual(&pose)),
        bits(&m.residual_scales(&pose)),
        matrix(&m.jacobian_unknowns(&pose)),
        matrix(&m.jacobian_inputs(&pose)),
        matrix(&m.jacobian_unknowns_scales(&pose)),
        matrix(&m.jacobian_inputs_scales(&pose)),
        bit(m.determinant(&pose)),
        bits(&m.block_determinants(&pose)),
        bit(m.length_scale(&pose)),
        format!("{:?}", m.check_implied(&q).map_err(|error| error.to_string())),
        format!("{:?}", m.is_within_ranges(&q).map_err(|error| error.to_string())),
        format!("{}", m.named(&q)),
        found(m.solve_jacobian(&pose, &m.residual_scales(&pose)), |solution| bits(&solution)),
        found(m.velocity_ratios(&pose), |ratios| matrix(&ratios)),
        found(m.points(&pose), |points| list(M::each_point(points))),
        found(m.outputs(&pose), |outputs| list(M::each_output(outputs))),
        found(m.point_ratios(&pose), |all| M::each_point(all).iter().map(matrix).collect()),
        found(m.output_ratios(&pose), |all| M::each_output(all).iter().map(matrix).collect()),
        found(m.motion(&q, given(0.7).into(), given(-0.3).into()), |motion| {
            let of =
                [position::<M>(&motion.position), rates::<M>(&motion.rates), accelerations::<M>(&motion.accelerations)];
            format!("{of:?} {} {}", list(M::each_point(motion.points)), list(M::each_output(motion.outputs)))
        }),
    ];
    all.extend((0..).map_while(|place| m.ranged(place, &q)).map(|ranged| format!("{ranged:?}")));
    if let Ok(moving) = m.velocity(&pose, given(0.7).into()) {
        all.push(rates::<M>(&moving));
        all.push(bits(&m.gamma(&pose, &moving)));
        all.push(found(m.point_velocities(&pose, &moving), |points| list(M::each_point(points))));
        all.push(found(m.output_rates(&pose, &moving), |outputs| list(M::each_output(outputs))));
        if let Ok(bent) = m.acceleration(&pose, &moving, given(0.2).into()) {
            all.push(accelerations::<M>(&bent));
            all.push(found(m.point_accelerations(&pose, &moving, &bent), |points| list(M::each_point(points))));
            all.push(found(m.output_accelerations(&pose, &moving, &bent), |all| list(M::each_output(all))));
        }
    }
    let branch = m.branch_of(&pose);
    all.push(found(m.kinematics(&q, branch, given(0.7).into(), given(0.2).into()), |found| {
        [
            position::<M>(&M::coordinates_of(&found.pose)),
            rates::<M>(&found.rates),
            accelerations::<M>(&found.accelerations),
        ]
        .join(" ")
    }));
    all.push(found(m.full_kinematics(&q, branch, given(0.7).into(), given(0.2).into()), |found| {
        let (points, outputs) = (M::each_point(found.points), M::each_output(found.outputs));
        format!("{} {} {}", accelerations::<M>(&found.accelerations), list(points), list(outputs))
    }));
    all
}

/// Positions by Newton's method, and their distance from singular ones.
fn searched<M: Mechanism<Scalar = f64>>(m: &M, at: &Numbers) -> Vec<String> {
    let guess = coordinates::<M>(at);
    let any = newton_any_branch(m, &guess);
    let any = found(any, |any| format!("{} {} {}", position::<M>(&any.coordinates), any.iterations, any.same_branch));
    let one = newton(m, &guess).map(|found| {
        let report = singularity::report(m, &m.pose_at(&found.coordinates));
        let report = report.map_or_else(|error| error.to_string(), |report| report.to_string());
        format!("{} {} {report}", position::<M>(&found.coordinates), found.iterations)
    });
    vec![any, found(one, |found| found)]
}

/// The way from each position to the inputs of another.
fn ways<M: Mechanism<Scalar = f64> + Clone>(m: &M, starts: &[Numbers]) -> Vec<String> {
    let pairs = starts.iter().zip(starts.iter().cycle().skip(1)).filter(|(start, to)| start[1] != to[1]);
    let ways = pairs.map(|(start, to)| {
        let start = coordinates::<M>(start);
        let to: PerInput<M> = Column::from_slice(&to[1]).expect("as many inputs");
        let inputs = Line { from: M::inputs(&start).into(), to: to.into() };
        let along = Along { mechanism: m.clone(), inputs };
        let path = Path::new(&along, &AlongCoordinates { q: start, parameter: 0.0 }, Direction::Increasing);
        let end = path.and_then(|mut path| path.advance_to(1.0));
        found(end, |step| format!("{} {}", position::<M>(&along.position(&step.position)), bit(step.length)))
    });
    ways.collect()
}

pub fn compare<const V: usize, M: Fixture<Scalar = f64, V = D<V>>>() {
    let Positions { mechanism, guesses, starts } = Positions::<M>::drawn(80);
    assert!(!starts.is_empty(), "{}", M::NAME);
    at_run_time::<V, M, _>(|own| {
        for at in guesses.iter().take(8).chain(&starts) {
            same::<M>(&functions(&mechanism, at), &functions(own, at));
            same::<M>(&searched(&mechanism, at), &searched(own, at));
        }
        same::<M>(&ways(&mechanism, &starts), &ways(own, &starts));
    });
}

/// Positions in closed form, and all positions.
fn listed<M: Kinematic<Scalar = f64> + Assembly + Branches>(m: &M, at: &[Numbers]) -> Vec<String> {
    let mut all = Vec::new();
    for numbers in at {
        let q = coordinates::<M>(numbers);
        let branch = m.branch_of(&m.pose_at(&q));
        let of = |pose: M::Pose| position::<M>(&M::coordinates_of(&pose));
        all.push(found(m.assemble(M::inputs(&q).into(), branch), of));
        all.push(found(m.assemble_near(&q, branch), of));
        all.push(found(m.all_positions(M::inputs(&q).into()), |found| {
            found
                .map(|(branch, q)| format!("{} {}", position::<M>(&q), m.branch_of(&m.pose_at(&q)) == branch))
                .collect()
        }));
    }
    all
}

pub fn compare_listed<const V: usize, M: Fixture<Scalar = f64, V = D<V>> + Assembly + Branches>() {
    let Positions { mechanism, guesses, starts } = Positions::<M>::drawn(6);
    at_run_time::<V, M, _>(|own| {
        for at in [&guesses, &starts] {
            same::<M>(&listed(&mechanism, at), &listed(own, at));
        }
    });
}

#[test]
fn positions_are_those_of_emitted_code() {
    closed!(compare_listed);
}

#[test]
fn functions_are_those_of_emitted_code() {
    eight!(compare);
}
