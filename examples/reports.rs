//! Reports of a wiper, of a lever with a short slot, of a door with its stops and of a parallelogram: what a designer asks
//! of a mechanism first.
//!
//! `cargo run --example reports` prints them and writes `target/report_wiper.html`, `target/report_slotted_lever.html`,
//! `target/report_door.html` and `target/report_parallelogram.html`, and the film `target/parallelogram.svg`, which moves
//! through both change points.

use std::error::Error;

use linkage::drawing::Animation;
use linkage::range_of_motion::{MotionEnd, RangeOfMotion};
use linkage::report::{GrashofClass, Report, ReportOptions};
use linkage::{Elbow, RangeEnd, linkage};
use linkage_examples::output;
use linkage_gallery::slotted_lever::SlottedLever;
use linkage_gallery::tilted_parallelogram::{TiltedParallelogram, TiltedParallelogramBranch};
use linkage_gallery::wiper::Wiper;

linkage! {
    /// A door leaf and the arms of its closer, in millimetres: the leaf opens by `theta`, and the arm at the closer on the
    /// frame turns by `psi`. It has stops.
    pub mechanism Door {
        param along = 220, off = 30, rod = 340, arm = 300, post_x = 480, post_y = 60;
        input theta in 0deg..110deg;
        unknown phi, psi;

        loop (along, off)@theta + rod@phi = (post_x, post_y) + arm@psi;

        point Hinge = (0, 0);
        point Shoe = (along, off)@theta;
        output turn = psi;
    }
}

fn write(report: &Report, name: &str) -> Result<(), String> {
    println!("{report}");
    println!("{}\n", output::write(format!("target/report_{name}.html"), &report.to_html())?);
    Ok(())
}

/// Both ends of the range of a coordinate.
fn ends(of: &'static str) -> [MotionEnd; 2] {
    [RangeEnd::Least, RangeEnd::Most].map(|end| MotionEnd::JointRange { of, end })
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = ReportOptions::default();

    let wiper = Wiper::default();
    let branch = wiper.branches(1.0)?.next().ok_or("no position")?.branch;
    let report = Report::on_branch(&wiper, Wiper::DERIVATION, branch, [1.0], &options)?;
    write(&report, "wiper")?;
    let motion = report.motion.as_ref().ok_or("no motion")?;
    // crank^2 + base^2 = link^2 + arm^2: both strokes take the same time.
    let first = motion.quantities.iter().find(|quantity| quantity.name == "first").ok_or("no wiper")?;
    assert!((first.time_ratio.ok_or("no strokes")? - 1.0).abs() < 1e-12);
    assert_eq!(motion.four_bars[0].class, GrashofClass::CrankRocker);

    // The pin meets both ends of the slot.
    let lever = SlottedLever::default();
    let branch = lever.branches(1.0)?.next().ok_or("no position")?.branch;
    let report = Report::on_branch(&lever, SlottedLever::DERIVATION, branch, [1.0], &options)?;
    write(&report, "slotted_lever")?;
    let motion = report.motion.as_ref().ok_or("no motion")?;
    assert_eq!(motion.ends, ends("s"));

    // The arms let the door open to its stop.
    let door = Door::default();
    let branch = door.branches(0.5)?.next().ok_or("no position")?.branch;
    let report = Report::on_branch(&door, Door::DERIVATION, branch, [0.5], &options)?;
    write(&report, "door")?;
    let motion = report.motion.as_ref().ok_or("no motion")?;
    assert_eq!(motion.ends, ends("theta"));

    // The cranks stay parallel where the links are in line.
    let parallelogram = TiltedParallelogram::default();
    let branch = TiltedParallelogramBranch::new(Elbow::Left);
    let range = RangeOfMotion::on_branch(&parallelogram, branch, [1.0], options.range)?;
    let report = Report::of(&parallelogram, TiltedParallelogram::DERIVATION, &range.at(1.0)?, &options)?;
    write(&report, "parallelogram")?;
    assert_eq!(report.motion.as_ref().ok_or("no motion")?.change_points.len(), 2);
    let film = Animation::over(&range)?;
    println!("{}", output::write("target/parallelogram.svg", &film.to_svg()?)?);
    Ok(())
}
