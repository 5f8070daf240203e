//! Drawings, films, charts of circuits, tables of motions and reports of mechanisms at run time: the texts of those of emitted
//! code, byte by byte.

use std::fmt::Display;

use linkage::circuits::{CircuitOptions, Circuits};
use linkage::continuation::{Along, AlongCoordinates, Line};
use linkage::derivation::Derivation;
use linkage::drawing::{Animation, CircuitChart, Drawing, DrawingError};
use linkage::range_of_motion::{MotionByLength, RangeOfMotion, RangeOptions};
use linkage::report::{Report, ReportOptions};
use linkage::sheet::ratio_properties;
use linkage::skeleton::{NoDrawing, Skeleton};
use linkage::{Assembly, Branches, Column, D, Dim, JointForces, Kinematic, Mechanism, PerInput, Scene, Table, linkage};
use linkage_gallery::Fixture;
use linkage_gallery::cart_pendulum::CartPendulum;
use linkage_gallery::double_pendulum::DoublePendulum;
use linkage_gallery::pendulum::Pendulum;
use linkage_gallery::three_link_arm::ThreeLinkArm;
use linkage_gallery::tilted_parallelogram::TiltedParallelogram;
use linkage_interpreter::{AtRunTime, Mechanism as Compiled, Program};

use super::one_loop::{self, Rocker};
use super::{Positions, at_run_time, compiled, coordinates, of_text};

with_text! {
    /// Two inputs.
    #[derive(Debug, Clone, Copy)]
    mechanism FiveBar {
        param ground = 4, crank = 1, rod = 4;
        input left, right;
        unknown phi, psi;
        loop crank@left + rod@phi = ground@0 + crank@right + rod@psi;
        point Tip = crank@left + rod@phi;
        derive drawing;
    }

    /// A slider with a guide, and forces in joints.
    mechanism Pump {
        param r = 0.05, l = 0.2, h = 0.01, m = 0.8, j = 1e-3, load = 120;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, h);
        point A = r@phi;
        body crank { inertia j; angle phi; }
        body rod { mass m; inertia j; center A + (l / 2)@psi; angle psi; }
        body piston { mass m; center (s, h); }
        scene Pumping { inertia; force (load, 0) at (s, h); reactions; }
        derive drawing;
    }
}

/// One rate of the input.
fn rate<M: Mechanism<Scalar = f64, V = D<1>>>(rate: f64) -> M::Inputs {
    PerInput::<M>::from([rate]).into()
}

fn written<T>(made: Result<T, impl Display>, write: impl FnOnce(T) -> String) -> String {
    made.map_or_else(|error| error.to_string(), write)
}

/// The drawing at a position with its velocities and accelerations, films, and the circuits at an input.
fn drawings<M>(m: &M, start: &M::Coordinates, branch: M::Branch) -> Vec<String>
where
    M: Kinematic<Scalar = f64, V = D<1>> + Skeleton + Assembly + Branches,
{
    let svg = |made: Result<String, DrawingError>| written(made, |svg| svg);
    let film = |made: Result<Animation, DrawingError>| svg(made.and_then(|film| film.to_svg()));
    let mut drawing = Drawing::of(m, &m.pose_at(start));
    if let Ok(motion) = m.motion(start, rate::<M>(1.0), rate::<M>(0.0)) {
        drawing.velocities(m, &motion.points).accelerations(m, &motion.points);
    }
    let mut all =
        vec![svg(drawing.to_svg()), film(Animation::turn(m, branch)), film(Animation::between(m, branch, [0.2, 0.7]))];
    if let Ok(motion) = MotionByLength::of(m, start, RangeOptions::default()) {
        all.push(film(Animation::along(&motion)));
    }
    if let Ok(circuits) = Circuits::of(m, 0.7, CircuitOptions::default()) {
        let unknowns = (0..m.dims().0.count()).map(|place| m.unknown_name(place).to_string());
        let charts = unknowns.chain(["no unknown".to_owned()]).map(|name| CircuitChart::of(m, &circuits, &name));
        all.extend(charts.map(|chart| written(chart, |chart| chart.to_svg())));
    }
    all
}

/// A turn as a table, with its marks and the reasons of cells without a number.
fn tables<M>(m: &M, branch: M::Branch) -> Vec<String>
where
    M: Kinematic<Scalar = f64, V = D<1>> + Assembly,
{
    let tables = [Table::turn(m, branch, 48, 2.0), Table::at(m, branch, &[0.1, 0.2, f64::NAN], 0.0)];
    let lines = tables.map(|table| match table {
        Ok(table) => {
            let missing = table.missing().iter().map(|missing| format!("{} {}", missing.row, missing.cause));
            let marks = table.marks().iter().map(|mark| format!("{mark:?}"));
            missing.chain(marks).chain([table.to_csv()]).collect()
        }
        Err(error) => vec![error.to_string()],
    });
    lines.into_iter().flatten().collect()
}

/// Reports as prose and as pages, and the properties of the velocity ratios.
fn reports<M>(m: &M, derivation: &Derivation<'_>, start: &M::Coordinates, branch: M::Branch) -> Vec<String>
where
    M: Kinematic<Scalar = f64, V = D<1>> + Assembly + Branches,
{
    let options = ReportOptions::default();
    let reports = [
        Report::of(m, derivation, start, &options),
        Report::on_branch(m, derivation, branch, [0.3, 1.0, 2.0], &options),
        Ok(Report::at(m, derivation, start)),
    ];
    let mut all: Vec<String> =
        reports.into_iter().map(|report| written(report, |report| format!("{report}{}", report.to_html()))).collect();
    let properties = ratio_properties(m, derivation, start, rate::<M>(2.0));
    all.push(written(properties, |all| all.map(|property| property.to_string()).join("\n")));
    all
}

/// All texts at each position at an input.
fn texts<M>(m: &M, derivation: &Derivation<'_>, input: f64) -> Vec<String>
where
    M: Kinematic<Scalar = f64, V = D<1>> + Skeleton + Assembly + Branches,
{
    let inputs: PerInput<M> = [input].into();
    let positions: Vec<_> = m.all_positions(inputs.into()).expect("positions").collect();
    let of = |(branch, q): (M::Branch, M::Coordinates)| {
        [drawings(m, &q, branch), tables(m, branch), reports(m, derivation, &q, branch)].concat()
    };
    positions.into_iter().flat_map(of).collect()
}

/// The motion of both cranks of a five-bar along a line of inputs, and its circuits.
fn along<M>(m: &M) -> Vec<String>
where
    M: Kinematic<Scalar = f64> + Skeleton + Branches + Clone,
{
    let inputs = |all: [f64; 2]| Column::from_slice(&all).expect("two inputs");
    let [from, to]: [PerInput<M>; 2] = [inputs([0.3, 1.9]), inputs([1.1, 1.2])];
    let line = Along { mechanism: m.clone(), inputs: Line { from: from.into(), to: to.into() } };
    let positions = m.all_positions(from.into()).expect("positions");
    let films = positions.map(|(_, q)| {
        let range = RangeOfMotion::of(&line, &AlongCoordinates { q, parameter: 0.0 }, RangeOptions::default());
        written(range, |range| written(Animation::over(&range).and_then(|film| film.to_svg()), |svg| svg))
    });
    let mut all: Vec<String> = films.collect();
    let circuits = Circuits::of(&line, 0.3, CircuitOptions::default());
    all.push(written(circuits, |circuits| written(CircuitChart::of(&line, &circuits, "phi"), |chart| chart.to_svg())));
    all
}

/// A scene at a position with the forces in its joints.
fn forces<S>(scene: &S, unknowns: &[f64], input: f64) -> Vec<String>
where
    S: Scene<Scalar = f64, Mechanism: Skeleton<Scalar = f64>>,
    S::Reactions: JointForces<f64, <S::Mechanism as Mechanism>::Name, Mechanism = S::Mechanism>,
{
    let (m, column) = (scene.mechanism(), |numbers: &[f64]| Column::from_slice(numbers));
    let inputs = Column::from_slice(&[input]).expect("one input");
    let q = S::Mechanism::coordinates(column(unknowns).expect("two unknowns"), inputs);
    let pose = m.pose_at(&q);
    let rates: PerInput<S::Mechanism> = Column::from_slice(&[30.0]).expect("one input");
    let found = scene.loads(0.0, &q, rates);
    vec![written(found, |loads| {
        let mut drawing = Drawing::of(m, &pose);
        written(drawing.forces(m, &pose, &loads.joints).force_unit("N").to_svg(), |svg| svg)
    })]
}

/// Compares texts, line by line.
#[track_caller]
fn same(emitted: &[String], at_run_time: &[String]) {
    for (emitted, at_run_time) in emitted.iter().zip(at_run_time) {
        for (one, other) in emitted.lines().zip(at_run_time.lines()) {
            assert_eq!(one, other);
        }
        assert_eq!(emitted, at_run_time);
    }
    assert_eq!(emitted.len(), at_run_time.len());
    assert!(emitted.iter().any(|text| text.contains("</svg>")));
}

/// A mechanism of this file as it is compiled at run time.
fn of_this_file(name: &str) -> Compiled {
    of_text(OF_THIS_FILE, name)
}

/// Calls a function with a mechanism at run time.
fn with<const V: usize, R>(of: &Compiled, call: impl FnOnce(&AtRunTime<'_, D<V>>) -> R) -> R {
    let design = of.design();
    let prepared = design.prepared().expect("a mechanism within the capacities");
    let result = call(&prepared.with_inputs().expect("as many inputs"));
    assert_eq!(prepared.failure(), None);
    result
}

/// Compares the texts of a mechanism at an input.
pub fn compare<M>(m: &M, derivation: &Derivation<'_>, of: &Compiled, input: f64)
where
    M: Kinematic<Scalar = f64, V = D<1>> + Skeleton + Assembly + Branches,
{
    same(&texts(m, derivation, input), &with::<1, _>(of, |m| texts(m, derivation, input)));
}

#[test]
fn pictures_and_reports_of_one_loop() {
    compare(&Rocker::default(), Rocker::DERIVATION, &one_loop::compiled("Rocker"), 0.4);
}

#[test]
fn pictures_and_reports_with_guides() {
    compare(&Pump::default(), Pump::DERIVATION, &of_this_file("Pump"), 0.7);
}

#[test]
fn pictures_and_reports_of_change_points() {
    let derivation = <TiltedParallelogram>::DERIVATION;
    compare(&TiltedParallelogram::default(), derivation, &compiled::<TiltedParallelogram>(), 0.7);
}

#[test]
fn films_of_two_inputs() {
    same(&along(&FiveBar::default()), &with::<2, _>(&of_this_file("FiveBar"), |m| along(m)));
}

#[test]
fn forces_in_joints() {
    let of = of_this_file("Pump");
    let scene = of.design().scene("Pumping").expect("the scene");
    let prepared = scene.prepared().expect("a scene within the capacities");
    let (unknowns, input) = ([-0.11, 0.237], 0.7);
    let here = forces(&prepared.with_inputs::<D<1>>().expect("one input"), &unknowns, input);
    assert_eq!(prepared.failure(), None);
    same(&forces(&Pumping::default(), &unknowns, input), &here);
    assert!(here[0].contains("on piston"));
}

/// Drawings of open chains.
fn compare_drawings<const V: usize, M: Fixture<Scalar = f64, V = D<V>> + Skeleton>() {
    let Positions { mechanism, starts, .. } = Positions::<M>::drawn(6);
    fn all<M: Mechanism<Scalar = f64> + Skeleton>(m: &M, starts: &[super::Numbers]) -> Vec<String> {
        let pose = |at| m.pose_at(&coordinates::<M>(at));
        starts.iter().map(|at| written(Drawing::of(m, &pose(at)).to_svg(), |svg| svg)).collect()
    }
    at_run_time::<V, M, _>(|own| same(&all(&mechanism, &starts), &all(own, &starts)));
}

#[test]
fn open_chains() {
    compare_drawings::<_, Pendulum>();
    compare_drawings::<_, DoublePendulum>();
    compare_drawings::<_, CartPendulum>();
    compare_drawings::<_, ThreeLinkArm>();
}

/// The reason why a text has no drawing, from a drawing, a film and a chart of circuits.
fn undrawn(program: &Program) -> NoDrawing {
    with::<1, _>(&program.mechanisms()[0], |m| {
        let inputs: Column<f64, D<1>> = [0.5].into();
        let q = m.all_positions(inputs).expect("positions").next().expect("a position").1;
        let pose = m.pose_at(&q);
        assert!(m.check_drawing().is_err(), "{:?}", m.joint_names().collect::<Vec<_>>());
        assert!(m.joints(&pose).as_slice().is_empty() && m.drawn_parts().is_empty() && m.joint_name(0).is_none());
        let circuits = Circuits::of(m, 0.5, CircuitOptions::default()).expect("circuits");
        let pictures = [
            Drawing::of(m, &pose).point("P", [0.0, 0.0]).to_svg(),
            Animation::of(m, [&pose, &pose], 1.0).to_svg(),
            CircuitChart::of(m, &circuits, m.unknown_name(0)).map(|chart| chart.to_svg()),
        ];
        let whys = pictures.map(|picture| match picture {
            Err(DrawingError::NoDrawing { mechanism, why }) if mechanism == m.name() => why,
            other => panic!("{other:?}"),
        });
        assert!(whys.iter().all(|why| *why == whys[0]));
        whys[0]
    })
}

#[test]
fn a_text_without_a_drawing_says_so() {
    let of = |drawing: &str| {
        let text = "param a = 1, b = 3; input t; unknown p, q; loop a@t + b@p = 2@0 + b@q;";
        Program::compile(&format!("mechanism Bars {{ {text} {drawing} }}")).expect("it compiles")
    };
    assert_eq!(undrawn(&of("")), NoDrawing::NotDerived);
    let mut written = serde_json::to_value(of("derive drawing;")).expect("a program");
    let joints = &mut written["mechanisms"][0]["written"]["drawing"]["joints"];
    *joints = (0..65).map(|place| format!("J{place}")).collect();
    let large: Program = serde_json::from_value(written).expect("a program");
    assert_eq!(undrawn(&large), NoDrawing::TooLarge { joints: 65, most: 64 });
}

#[test]
fn a_part_of_a_joint_that_does_not_exist_is_damage() {
    let mut written =
        serde_json::to_value(Program::compile(one_loop::OF_THIS_FILE).expect("it compiles")).expect("a program");
    written["mechanisms"][0]["written"]["drawing"]["parts"][0] =
        serde_json::json!({ "Sleeve": { "pin": 0, "on": 1, "towards": 9 } });
    let error = serde_json::from_value::<Program>(written).expect_err("damage").to_string();
    assert_eq!(error, "the compiled mechanism `CrankRocker` is damaged: a joint of a part does not exist");
}
