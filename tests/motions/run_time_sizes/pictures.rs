//! Drawings, films, tables, reports and properties of ratios of any mechanism, as texts.

use std::fmt::Display;

use linkage::circuits::{CircuitOptions, Circuits};
use linkage::derivation::Derivation;
use linkage::drawing::{Animation, CircuitChart, Drawing, DrawingError};
use linkage::range_of_motion::{MotionByLength, RangeOptions};
use linkage::report::{Report, ReportOptions};
use linkage::sheet::ratio_properties;
use linkage::skeleton::Skeleton;
use linkage::{Assembly, Branches, D, Dim, Kinematic, Mechanism, PerInput, Table};

/// One rate of the input.
fn rate<M: Mechanism<Scalar = f64, V = D<1>>>(rate: f64) -> M::Inputs {
    PerInput::<M>::from([rate]).into()
}

fn written<T>(made: Result<T, impl Display>, write: impl FnOnce(T) -> String) -> String {
    made.map_or_else(|error| error.to_string(), write)
}

/// The drawing at a position with its velocities and accelerations, films, and the circuits at an input.
pub fn drawings<M>(m: &M, start: &M::Coordinates, branch: M::Branch) -> Vec<String>
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
pub fn tables<M>(m: &M, branch: M::Branch) -> Vec<String>
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
pub fn reports<M>(m: &M, derivation: &Derivation<'_>, start: &M::Coordinates, branch: M::Branch) -> Vec<String>
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
