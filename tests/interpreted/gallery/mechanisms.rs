//! Every algorithm on every mechanism of the gallery.

use linkage::{Branches, D};
use linkage_gallery::four_bar::FourBar;
use linkage_gallery::geneva::Geneva;
use linkage_gallery::jansen::Jansen;
use linkage_gallery::offset_slider_crank::OffsetSliderCrank;
use linkage_gallery::one_window::OneWindow;
use linkage_gallery::stephenson_iii::StephensonIII;
use linkage_gallery::wiper::Wiper;
use linkage_gallery::{Fixture, all_mechanisms};

use crate::algorithms::motions::{circuits, compare, compare_along, compare_circuits, line};
use crate::algorithms::one_loop::{self, Block, CrankRocker};
use crate::algorithms::{Positions, at_run_time, certificates, functions, pictures, same};

macro_rules! functions_of {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        $($(functions::compare::<_, linkage_gallery::$file::$Mechanism>();)+)*
    };
}

macro_rules! numbers_of {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        $($(certificates::formulas::compare::<_, linkage_gallery::$file::$Mechanism>();)+)*
    };
}

macro_rules! motions_of {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        $($(compare_along::<_, linkage_gallery::$file::$Mechanism>();)+)*
    };
}

/// Mechanisms whose positions are listed.
macro_rules! listed {
    (positions $file:ident $Mechanism:ident closed) => {
        functions::compare_listed::<_, linkage_gallery::$file::$Mechanism>();
    };
    (circuits $file:ident $Mechanism:ident closed) => {
        // Each position begins a motion.
        if linkage_gallery::$file::$Mechanism::<f64>::branches().len() <= most_branches() {
            compare_circuits_along::<_, linkage_gallery::$file::$Mechanism>();
        }
    };
    ($question:ident $file:ident $Mechanism:ident $method:ident) => {};
}

macro_rules! positions_of {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        $($(listed!(positions $file $Mechanism $method);)+)*
    };
}

macro_rules! circuits_of {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        $($(listed!(circuits $file $Mechanism $method);)+)*
    };
}

/// A mechanism with two branches takes about 10 seconds.
const MOST_BRANCHES: usize = 1;

/// The most branches of a mechanism whose circuits are compared: `BRANCHES=1000` is the whole gallery.
fn most_branches() -> usize {
    std::env::var("BRANCHES").ok().and_then(|text| text.parse().ok()).unwrap_or(MOST_BRANCHES)
}

fn compare_circuits_along<const V: usize, M: Fixture<Scalar = f64, V = D<V>> + Branches>() {
    let Positions { mechanism, starts, .. } = Positions::<M>::drawn(80);
    let start = starts.first().expect("a position");
    at_run_time::<V, M, _>(|own| {
        same::<M>(&circuits(&line(&mechanism, start), 0.3), &circuits(&line(own, start), 0.3));
    });
}

#[test]
fn functions_of_the_whole_gallery() {
    all_mechanisms!(functions_of);
}

#[test]
fn positions_of_the_whole_gallery() {
    all_mechanisms!(positions_of);
}

#[test]
fn numbers_of_formulas_of_the_whole_gallery() {
    all_mechanisms!(numbers_of);
}

#[test]
fn motions_of_the_whole_gallery() {
    all_mechanisms!(motions_of);
}

#[test]
fn circuits_of_the_whole_gallery() {
    all_mechanisms!(circuits_of);
}

#[test]
fn motions_of_one_loop() {
    compare::<FourBar>();
    // Change points, and turns that are counted.
    compare::<OneWindow>();
    compare::<Geneva>();
}

#[test]
fn motions_of_several_groups() {
    compare::<Wiper>();
    compare::<Jansen>();
}

#[test]
fn motions_without_a_closed_form() {
    compare::<StephensonIII>();
}

#[test]
fn circuits_at_an_input() {
    compare_circuits::<FourBar>();
    compare_circuits::<Wiper>();
}

#[test]
fn certificates_of_one_loop() {
    certificates::compare(&CrankRocker::default(), &one_loop::compiled("CrankRocker"), 1.0);
    certificates::compare(&Block::default(), &one_loop::compiled("Block"), 0.9);
    certificates::compare_fixture::<OffsetSliderCrank>(1.0);
    certificates::compare_turn::<OneWindow>(1.0);
}

#[test]
fn pictures_and_reports() {
    pictures::compare(&CrankRocker::default(), CrankRocker::DERIVATION, &one_loop::compiled("CrankRocker"), 1.0);
    pictures::compare(&Block::default(), Block::DERIVATION, &one_loop::compiled("Block"), 0.9);
}
