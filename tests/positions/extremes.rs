//! Smallest and largest values of outputs over a range of the input, and the motion over a turn as a table.

use std::f64::consts::{PI, TAU};

use approx::assert_relative_eq;
use linkage::extremes::{over_range, over_turn};
use linkage::table::{Cause, Missing};
use linkage::{Elbow, OutputMotion, PathError, PositionError, Slider, Table, linkage};

linkage! {
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 = l1@0 + l4@theta4;
        output mu = theta4 - theta3;
        output _height = l2 * sin(theta2) + (l3 / 2) * sin(theta3);
        derive lanes;
    }
    pub mechanism SliderCrank {
        param r = 20, l = 60, e = 15;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, e);
        output stroke = s;
        derive lanes;
    }
}

/// By the law of cosines: |B D| is l1 - l2 and l1 + l2 where the crank is in line with the frame.
#[test]
fn the_transmission_angle_of_four_bars() {
    for (l1, l2, l3, l4) in
        [(80.0, 20.0, 50.0, 70.0), (7.3, 1.9, 5.0, 6.1), (1e-3, 2.1e-4, 8e-4, 7e-4), (3.0, 0.4, 2.5, 2.2)]
    {
        let m = FourBar { l1, l2, l3, l4 };
        let branch = FourBarBranch::new(Elbow::Left);
        let mu = over_turn(|v| Ok(m.full_kinematics(v, branch, 1.0, 0.0)?.outputs.mu)).unwrap();
        let angle = |diagonal: f64| ((l3 * l3 + l4 * l4 - diagonal * diagonal) / (2.0 * l3 * l4)).acos();
        let expected = [angle(l1 - l2), angle(l1 + l2)];
        // theta4 - theta3 is the angle between the links, seen from their other ends; its sign and turn are arbitrary.
        let found = [mu.least.value, mu.largest.value].map(|mu| mu.cos().acos());
        let mut sorted = found;
        sorted.sort_by(f64::total_cmp);
        assert_relative_eq!(sorted[0], expected[0], max_relative = 4e-15);
        assert_relative_eq!(sorted[1], expected[1], max_relative = 4e-15);
        let mut inputs = [mu.least.input, mu.largest.input];
        inputs.sort_by(f64::total_cmp);
        // At 0 or at a turn, and at half a turn.
        assert!(inputs.iter().any(|v| (v - PI).abs() < 1e-9) && inputs.iter().any(|v| v % TAU < 1e-9), "{inputs:?}");
    }
}

/// The ends of the stroke of an offset slider-crank: sqrt((l + r)^2 - e^2) and sqrt((l - r)^2 - e^2), to an ulp or two.
#[test]
fn the_stroke_of_a_slider() {
    let m = SliderCrank::default();
    let branch = SliderCrankBranch { psi_s: Slider::Far };
    let stroke = over_turn(|v| Ok(m.full_kinematics(v, branch, 1.0, 0.0)?.outputs.stroke)).unwrap();
    let end = |reach: f64| (reach * reach - m.e * m.e).sqrt();
    for (found, reach) in [(stroke.largest, m.l + m.r), (stroke.least, m.l - m.r)] {
        assert_relative_eq!(found.value, end(reach), max_relative = 2.0 * f64::EPSILON);
    }
    assert_relative_eq!(stroke.largest.input, (m.e / (m.l + m.r)).asin(), max_relative = 1e-14);
    assert_relative_eq!(stroke.least.input, PI + (m.e / (m.l - m.r)).asin(), max_relative = 1e-14);
}

/// Two extremes between neighbouring steps: the derivative does not change its sign from one step to the next.
#[test]
fn two_extremes_within_a_step() {
    // (x - c)^3 - 3 a^2 (x - c) has a maximum at c - a and a minimum at c + a, closer than a 360th of the range.
    let (c, a) = (0.501_3_f64, 4e-4);
    let cubic = |x: f64| {
        let u = x - c;
        Ok(OutputMotion { value: (u * u - 3.0 * a * a) * u, rate: 3.0 * (u * u - a * a), acceleration: 6.0 * u })
    };
    let found = over_range([c - 1.9 * a, c + 1.9 * a], cubic).unwrap();
    assert_relative_eq!(found.largest.value, 2.0 * a * a * a, max_relative = 1e-12);
    // Over a wide range the ends are the extremes.
    let wide = over_range([0.0, 1.0], cubic).unwrap();
    assert_eq!((wide.least.input, wide.largest.input), (0.0, 1.0));
    // A bump between two of 360 steps, on a slope.
    let bump = |x: f64| {
        let u = (x - c) / a;
        let bell = 1.0 / (1.0 + u * u);
        let (first, second) = (-2.0 * u * bell * bell, (6.0 * u * u - 2.0) * bell * bell * bell);
        Ok(OutputMotion { value: bell, rate: first / a, acceleration: second / (a * a) })
    };
    let found = over_range([0.0, 1.0], bump).unwrap();
    assert_eq!((found.largest.input, found.largest.value), (c, 1.0));
}

/// Zeros of the derivative at an end and at a sample hide no other in the same step.
#[test]
fn extremes_next_to_a_zero_at_a_sample() {
    for w in [0.002, 1e-3, 1e-5] {
        for centre in [0.0, 0.5, 1.0] {
            // ((x - c)^2 - w^2)^2 / w^4 - 1 is 0 at c and -1 at c +- w.
            let well = |x: f64| {
                let u = (x - centre) / w;
                let [value, first, second] = [u * u * (u * u - 2.0), 4.0 * u * (u * u - 1.0), 12.0 * u * u - 4.0];
                Ok(OutputMotion { value, rate: first / w, acceleration: second / (w * w) })
            };
            let found = over_range([0.0, 1.0], well).unwrap();
            assert_relative_eq!(found.least.value, -1.0, max_relative = 1e-9);
            assert_relative_eq!((found.least.input - centre).abs(), w, max_relative = 1e-9);
        }
    }
}

/// A polynomial with five extremes within a step.
#[test]
fn several_extremes_within_a_step() {
    // The Chebyshev polynomial T6 on an interval of half a step, and outside of it a steep rise.
    let (c, a) = (0.501_3, 0.5 / 360.0 * 0.45);
    let wave = |x: f64| {
        let u: f64 = (x - c) / a;
        let square = u * u;
        let value = ((32.0 * square - 48.0) * square + 18.0) * square - 1.0;
        let rate = ((192.0 * square - 192.0) * square + 36.0) * u / a;
        let acceleration = ((960.0 * square - 576.0) * square + 36.0) / (a * a);
        Ok(OutputMotion { value, rate, acceleration })
    };
    let found = over_range([c - 1.001 * a, c + 0.999 * a], wave).unwrap();
    assert_relative_eq!(found.least.value, -1.0, max_relative = 1e-12);
    let found = over_range([0.0, 1.0], wave).unwrap();
    assert_relative_eq!(found.least.value, -1.0, max_relative = 1e-9);
}

#[test]
fn errors_are_those_of_the_quantity() {
    let m = FourBar { l2: 300.0, ..FourBar::default() };
    let branch = FourBarBranch::new(Elbow::Left);
    let found = over_turn(|v| Ok(m.full_kinematics(v, branch, 1.0, 0.0)?.outputs.mu));
    assert!(matches!(found, Err(PositionError::Unbuildable { .. })), "{found:?}");
}

/// Every number of the CSV reads back as the bits of `full_kinematics`.
#[test]
fn a_turn_as_a_table() {
    let (m, branch) = (SliderCrank::default(), SliderCrankBranch { psi_s: Slider::Far });
    let table = Table::turn(&m, branch, 24, 10.0).unwrap();
    let csv = table.to_csv();
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(names, table.names());
    let place = |name: &str| names.iter().position(|other| *other == name).unwrap();
    for (step, line) in lines.enumerate() {
        let row: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let phi = TAU * step as f64 / 24.0;
        let motion = m.full_kinematics(phi, branch, 10.0, 0.0).unwrap();
        let expected = [
            ("phi", phi),
            ("s", motion.pose.s),
            ("s_rate", motion.rates.s),
            ("s_acceleration", motion.accelerations.s),
        ];
        for (name, value) in expected {
            assert_eq!(row[place(name)].to_bits(), value.to_bits(), "{name}");
        }
        assert_eq!(table.column("s").unwrap()[step].to_bits(), motion.pose.s.to_bits());
    }
    assert_eq!((table.len(), table.missing().len(), table.column("none")), (25, 0, None));
}

#[test]
fn inputs_without_a_position_have_empty_cells() {
    let m = SliderCrank { l: 10.0, e: 0.0, ..SliderCrank::default() };
    let table = Table::turn(&m, SliderCrankBranch { psi_s: Slider::Far }, 360, 1.0).unwrap();
    let [inputs, places] = ["phi", "s"].map(|name| table.column(name).unwrap());
    let reached: Vec<f64> = inputs.iter().zip(places).filter(|(_, s)| s.is_finite()).map(|(phi, _)| *phi).collect();
    // |sin phi| <= 1/2 in one motion about 0, and in another about 180 degrees; at the limits the velocity is infinite.
    // A limit of these inputs is inside by an ulp. 0 and 360 degrees are two rows.
    assert!(reached.iter().all(|phi| phi.sin().abs() < 0.5 && phi.cos() > 0.0));
    assert_eq!((inputs.len(), reached.len(), table.missing().len()), (361, 61, 300));
    for Missing { row, cause } in table.missing() {
        assert!(places[*row].is_nan());
        let is_at_or_beyond_the_end = matches!(
            cause,
            Cause::Path(PathError::DeadPoint { .. } | PathError::Position(PositionError::Singular { .. }))
        );
        assert!(is_at_or_beyond_the_end, "{cause}");
    }
    let csv = table.select(["phi", "s", "s_rate"]).unwrap().to_csv();
    assert_eq!(csv.lines().filter(|line| line.ends_with(",,")).count(), 300);
    assert_eq!(csv.lines().count(), 362);
    assert!(!table.to_csv().contains("NaN"));
    // The ends of the motion are marks, in degrees as its input.
    let table = table.degrees();
    let ends = table.marks().iter().map(|mark| (mark.name.as_str(), mark.at.round()));
    assert_eq!(ends.collect::<Vec<_>>(), [("dead point", 330.0), ("dead point", 30.0)]);
}
