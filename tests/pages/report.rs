//! Reports as prose and as pages.

use linkage::continuation::Options;
use linkage::range_of_motion::RangeOptions;
use linkage::report::{Report, ReportOptions};
use linkage_gallery::crank_shaper::*;
use linkage_gallery::five_bar::*;
use linkage_gallery::stephenson_ii::*;
use linkage_gallery::wiper::*;

use super::sheet::assert_balanced;

fn wiper(options: &ReportOptions) -> Report {
    let m = Wiper::default();
    let branch = m.branches(1.0).unwrap().next().unwrap().branch;
    Report::on_branch(&m, Wiper::DERIVATION, branch, [1.0], options).unwrap()
}

fn shaper() -> Report {
    let m = CrankShaper::default();
    let branch = m.branches(1.0).unwrap().next().unwrap().branch;
    Report::on_branch(&m, CrankShaper::DERIVATION, branch, [1.0], &ReportOptions::default()).unwrap()
}

/// Each section says what there is, or that there is nothing.
#[test]
fn prose() {
    let text = wiper(&ReportOptions::default()).to_string();
    for part in [
        "6 links (ground, theta, phi, first, rod, second) meet in 7 joints, all of which turn. They form 2 loops.",
        "3·(6 − 1) − 2·7 = 1",
        "At theta = 57.29578° there are 4 modes on 4 motions, which form 4 circuits.",
        "theta turns fully, without limits: the motion closes after 1 turn.",
        "is a crank-rocker, seen from theta",
        "is a change-point linkage, seen from first",
        "The time ratio of both strokes is 1.",
        "rod is 10° all the time.",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let text = shaper().to_string();
    for part in ["of which 5 turn and 2 slide", "there is no Grashof class", "is 90° all the time", "1.753317"] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    // A stated range.
    let path = Options { range: Some([0.5, 2.0]), ..RangeOptions::through_change_points().path };
    let range = RangeOptions { path, ..RangeOptions::through_change_points() };
    let text = wiper(&ReportOptions { range, ..ReportOptions::default() }).to_string();
    assert!(text.contains("The lower end is that of the range that was asked for"), "{text}");
}

/// Numbered positions have modes and motions; a group of two loops is no dyad.
#[test]
fn a_group_without_a_closed_form() {
    let m = StephensonII::default();
    let start = m.branches(1.0).unwrap().next().unwrap().pose.coordinates();
    let report = Report::of(&m, StephensonII::DERIVATION, &start, &ReportOptions::default()).unwrap();
    let text = report.to_string();
    assert!(text.contains("has no transmission angle: two loops of links: up to 6 positions."), "{text}");
    assert_balanced(&report.to_html());
}

#[test]
fn pages_are_whole() {
    let five_bar = FiveBar::default();
    let position = five_bar.branches(FiveBarInputs { theta1: 1.0, theta4: 2.0 });
    let position = position.unwrap().next().unwrap().pose.coordinates();
    let several = Report::at(&five_bar, FiveBar::DERIVATION, &position);
    for report in [wiper(&ReportOptions::default()), shaper(), several] {
        let html = report.to_html();
        assert_balanced(&html);
        assert!(
            html.starts_with("<!DOCTYPE html>") && html.contains("lang=\"en\"") && html.contains("name=\"viewport\"")
        );
        for foreign in ["<script", "<link", "http:", "https:", "@import", "url(", " onload", "NaN"] {
            assert!(!html.contains(foreign), "{foreign}");
        }
        assert!(html.contains(&report.to_html_fragment()));
        let outputs = report.motion.iter().flat_map(|motion| &motion.quantities).filter(|one| one.is_output).count();
        assert_eq!(html.matches("<polyline").count(), outputs);
    }
}
