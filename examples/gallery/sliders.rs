//! Mechanisms with sliders.

use std::error::Error;

use linkage::Slider::Far;
use linkage::nalgebra::{center, vector};

use crate::figure::{Course, Figure, along, at};

use linkage_gallery::crank_shaper::*;
use linkage_gallery::elliptic_trammel::*;
use linkage_gallery::inverted_slider_crank::*;
use linkage_gallery::offset_slider_crank::*;
use linkage_gallery::scotch_yoke::*;
use linkage_gallery::whitworth::*;

pub fn figures() -> Result<Vec<Figure>, Box<dyn Error>> {
    Ok(vec![
        offset_slider_crank()?,
        inverted_slider_crank()?,
        whitworth()?,
        crank_shaper()?,
        scotch_yoke()?,
        elliptic_trammel()?,
    ])
}

fn offset_slider_crank() -> Result<Figure, Box<dyn Error>> {
    let m = OffsetSliderCrank::default();
    let mut figure = assembled!("Offset slider-crank", OffsetSliderCrank,
        m on OffsetSliderCrankBranch::new(Far), from 60.0,
        |pose, points| [("M", center(&points.a, &points.b))]);
    figure.picture.crank(&["O", "A"]).link(&["A", "M", "B"]).slider("B").ground("O").trace("M");
    Ok(figure.words(
        "The line of the slider misses the crank pivot, so that one stroke is slower than the other.",
        "R. L. Norton, Design of Machinery, chapter 4",
    ))
}

fn inverted_slider_crank() -> Result<Figure, Box<dyn Error>> {
    let m = InvertedSliderCrank::default();
    let mut figure = assembled!("Inverted slider-crank", InvertedSliderCrank,
        m on InvertedSliderCrankBranch::new(Far), from 60.0,
        |pose, points| [("Tip", along(points.b, points.a, m.a + m.d + 15.0))]);
    figure.picture.bent(&["D", "B", "Tip"]).crank(&["O", "A"]).sleeve("A", ["B", "A"]);
    figure.picture.ground("O").ground("D").trace("Tip");
    Ok(figure.words(
        "The crank pin slides on a rocking arm, as in a steam engine with an oscillating cylinder.",
        "R. L. Norton, Design of Machinery, section 4.7",
    ))
}

fn whitworth() -> Result<Figure, Box<dyn Error>> {
    let m = Whitworth::default();
    let mut figure = assembled!("Whitworth's quick return", Whitworth,
    m on WhitworthBranch::new(Far, Far), from 60.0,
    |pose, points| [
        ("Tip", along(points.e, points.c, m.arm + m.crank + m.offset + 12.0)),
        ("M", center(&points.e, &points.ram)),
    ]);
    figure.picture.link(&["E", "C", "Tip"]).crank(&["O", "Pin"]).sleeve("Pin", ["E", "C"]);
    figure.picture.link(&["E", "M", "Ram"]).slider("Ram").ground("O").ground("C").trace("M");
    Ok(figure.words(
        "The crank drives a slotted arm through full turns, slowly forward and fast back.",
        "J. Whitworth, British patent 12907 (1849)",
    ))
}

fn crank_shaper() -> Result<Figure, Box<dyn Error>> {
    let m = CrankShaper::default();
    let mut figure = assembled!("Crank shaper", CrankShaper,
        m on CrankShaperBranch::new(Far, Far), from 60.0,
        |pose, points| [("M", center(&points.e, &points.ram))]);
    figure.picture.link(&["C", "E"]).crank(&["O", "Pin"]).sleeve("Pin", ["C", "E"]);
    figure.picture.link(&["E", "M", "Ram"]).slider("Ram").ground("O").ground("C").trace("M");
    Ok(figure.words(
        "The slotted lever of the shaping machine swings, and cuts slowly and returns fast.",
        "R. Willis, Principles of Mechanism (1841)",
    ))
}

fn scotch_yoke() -> Result<Figure, Box<dyn Error>> {
    let m = ScotchYoke::default();
    let mut figure = assembled!("Scotch yoke", ScotchYoke, m on ScotchYokeBranch::new(), from 40.0,
    |pose, points| [
        ("O", at(0.0, 0.0)),
        ("Pin", at(m.r * pose.phi.re, m.r * pose.phi.im)),
        ("Top", points.slider + vector![0.0, 1.3 * m.r]),
        ("Bottom", points.slider - vector![0.0, 1.3 * m.r]),
        ("End", points.slider + vector![2.4 * m.r, 0.0]),
    ]);
    figure.picture.bent(&["Top", "Bottom", "Slider", "End"]).slider("End").crank(&["O", "Pin"]);
    figure.picture.sleeve("Pin", ["Bottom", "Top"]).ground("O").trace("Pin");
    Ok(figure.words("A pin in the slot of a yoke: the motion of the yoke is a cosine.", "A textbook mechanism"))
}

fn elliptic_trammel() -> Result<Figure, Box<dyn Error>> {
    let m = EllipticTrammel::default();
    let mut figure = assembled!("Elliptic trammel", EllipticTrammel, m on EllipticTrammelBranch::new(), from 50.0,
        |pose, points| []);
    figure.picture.crank(&["A", "B", "Pen"]).slider("A").slider("B").trace("Pen");
    Ok(figure.words(
        "The ends of a rod slide on two perpendicular lines; every point of it draws an ellipse.",
        "Proclus, commentary on the first book of Euclid",
    ))
}
