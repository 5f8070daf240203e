//! The functions that emitted code calls take names that are not static, and return them in their errors.

use linkage_runtime::__rt::{
    AssemblyMode, Elbow, Factorization, Loops, Memory, OutputMotion, Point2, PointMotion, SMatrix, Triangle, Vector2,
    at_named, chord, countable, elbow_chord, existing, finite, finite_matrices, finite_matrix, finite_outputs,
    finite_points, finite_vectors, implied, newton_group, no_closed_form, no_list, output_motions, point_motions,
    reach_chord, reachable, regular, solvable, too_many_branches,
};
use linkage_runtime::PositionError;

const NAN: f64 = f64::NAN;

/// The text of the error.
fn text<P>(result: Result<P, PositionError<&str>>) -> String {
    result.map(|_| ()).expect_err("these arguments are errors").to_string()
}

#[test]
fn names_need_not_be_static() {
    // Dropped before the end of the program.
    let [m, g, q] = ["Machine", "alpha, beta", "speed"].map(str::to_owned);
    let (m, g, q) = (m.as_str(), g.as_str(), q.as_str());
    let not_finite = "speed of Machine is not a finite number";
    let nowhere = |_: [f64; 2]| ([1.0; 2], [1.0; 2], [[1.0, 0.0], [0.0, 1.0]]);
    let finite_ones = [
        text(finite(m, q, [1.0, NAN])),
        text(finite_matrix(m, q, &SMatrix::<f64, 1, 1>::new(NAN))),
        text(finite_points::<_, _, [Point2<f64>; 1], 1>(m, q, [[NAN, 0.0]])),
        text(finite_vectors::<_, _, [Vector2<f64>; 1], 1>(m, q, [[NAN, 0.0]])),
        text(finite_outputs::<_, _, [f64; 1], 1>(m, q, [NAN])),
        text(finite_matrices::<_, _, [SMatrix<f64, 1, 1>; 1], 1, 1, 1>(m, q, [[[NAN]]])),
    ];
    assert!(finite_ones.iter().all(|text| text == not_finite), "{finite_ones:?}");
    let motion = "motion of Machine is not a finite number";
    assert_eq!(text(point_motions::<_, _, [PointMotion; 1], 1>(m, [[[NAN, 0.0]; 3]])), motion);
    assert_eq!(text(output_motions::<_, _, [OutputMotion; 1], 1>(m, [[NAN; 3]])), motion);
    assert_eq!(text(countable(m, [NAN])), "the guess of Machine is not a finite number");
    assert!(text(countable(m, [1e300])).starts_with("the guess of an angle of Machine is 1e300"));
    assert!(text(implied(m, [q], [1.0], [1.0])).starts_with("speed of Machine does not close"));
    let groups = [
        text(no_closed_form::<(), _>(m, g)),
        text(no_list::<(), _>(m, g)),
        text(regular(m, g, 0.0, 1.0)),
        text(Factorization::new(m, g, [[1.0, 1.0], [1.0, 1.0]], [1.0; 2])),
        text(newton_group(m, g, [0.0, 0.0], nowhere)),
        text(Memory::<f64, 1, 2>::default().modes(
            m,
            g,
            Loops { constants: [[1.0, 0.0]], factors: [[[1.0, 0.0]; 2]] },
            |angles| angles,
            nowhere,
        )),
    ];
    for text in &groups {
        assert!(text.contains("Machine") && text.contains("alpha, beta"), "{text}");
    }
    assert!(text(too_many_branches::<(), _>(m)).starts_with("Machine has too many branches"));
    let undetermined = |_| Err::<(), _>(PositionError::NotFinite { mechanism: m, quantity: q });
    assert_eq!(text(existing([AssemblyMode::OfGuess].into_iter(), undetermined)), not_finite);
}

#[test]
fn inputs_have_names_that_are_not_static() {
    let [m, g, angle, length] = ["Machine", "alpha, beta", "theta", "s"].map(str::to_owned);
    let (m, g, names) = (m.as_str(), g.as_str(), [angle.as_str(), length.as_str()]);
    let here = at_named(m, &names, &[true, false], [core::f64::consts::FRAC_PI_3, 0.25]);
    let far = Triangle {
        links: [1.0, 1.0],
        line: [3.0, 0.0],
        scale: 3.0,
        reach_squared: 4.0,
        distance_squared: 9.0,
        factors: [-5.0, 9.0],
    };
    let apart = [
        text(chord(here, g, [-1.0, 3.0], 1.0, [1.0; 2], Elbow::Left)),
        text(reach_chord(here, g, [-1.0, 3.0], 1.0, [1.0; 2], Elbow::Left)),
        text(elbow_chord(here, g, far, Elbow::Left)),
        text(solvable(here, g, 0.0, [1.0, 0.0], [1.0, 1.0])),
        text(reachable(here, g, -1.0)),
    ];
    for text in &apart {
        let expected = "Machine cannot be assembled at theta = 60°, s = 0.25: group alpha, beta does not close";
        assert!(text.starts_with(expected), "{text}");
    }
    assert!(text(reachable(m, g, -1.0)).starts_with("Machine cannot be assembled at this input: group alpha, beta"));
}
