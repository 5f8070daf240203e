//! A reciprocating compressor: the loads on all bearings over a turn, and its balancing masses.
//!
//! `cargo run --example compressor` finds the counterweight and the mass on a balance shaft with the least shaking
//! force, prints the greatest loads, and writes `target/compressor.html`.

use std::error::Error;

use linkage_examples::output;

mod balance;
mod loads;
mod machine;
mod pictures;

use balance::{balanced, by_both, by_counterweight, shaking};
use loads::Loads;
use machine::Running;

/// The crank angles of a turn in the search, and in the report.
const COARSE: u32 = 90;
const FINE: u32 = 720;

/// A machine as it is balanced, with its loads over a turn.
pub struct Balanced {
    pub name: &'static str,
    /// The counterweight and the mass on the balance shaft.
    pub masses: [f64; 2],
    pub loads: Vec<Loads>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let bare = Running::default();
    let machines = [
        ("without", [0.0, 0.0]),
        ("counterweight", by_counterweight(&bare, COARSE)?),
        ("both", by_both(&bare, COARSE)?),
    ];
    let machines = machines.map(|(name, masses)| -> Result<Balanced, linkage::Error> {
        Ok(Balanced { name, masses, loads: Loads::turn(&balanced(&bare, masses), FINE)? })
    });
    let machines: Vec<Balanced> = machines.into_iter().collect::<Result<_, _>>()?;
    by_theory(&bare, &machines)?;
    let rows = report(&machines);
    for [name, value] in &rows {
        println!("{name:44} {value}");
    }
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/compressor.html".to_owned());
    let path = output::write(path, &pictures::page(&bare, &machines, &rows)?)?;
    println!("Pictures: {path}");
    Ok(())
}

/// Compares with the rod as two masses at its pins (R. L. Norton, *Design of Machinery*, chapter 13): rotating masses
/// balance the rotating part and half of the reciprocating one, the shaft the other half of the first order; the second
/// order remains.
fn by_theory(bare: &Running<f64>, machines: &[Balanced]) -> Result<(), Box<dyn Error>> {
    let [r, l] = [bare.mechanism.r, bare.mechanism.l];
    let rotating = bare.m2 * bare.b2 / r + bare.m3 * (1.0 - bare.mechanism.b3 / l);
    let reciprocating = bare.m4 + bare.m3 * bare.mechanism.b3 / l;
    let [weight, shaft] = machines[2].masses;
    let [moment, against] = [weight * bare.rc, shaft * bare.rb].map(|moment| moment / r);
    let second = reciprocating * r * bare.omega.powi(2) * r / l;
    let left = shaking(&balanced(bare, machines[2].masses), FINE)?;
    let close = |what: &str, found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 0.05, "{what}: {found} is not about {expected}");
    };
    close("counterweight", moment, rotating + reciprocating / 2.0);
    close("balance shaft", against, reciprocating / 2.0);
    close("second order", left, second);
    Ok(())
}

fn greatest(loads: &[Loads], of: impl Fn(&Loads) -> f64) -> f64 {
    loads.iter().map(of).fold(0.0, f64::max)
}

fn report(machines: &[Balanced]) -> Vec<[String; 2]> {
    let loads = &machines[0].loads;
    let kilonewtons = |of: fn(&Loads) -> f64| format!("{:.3} kN", greatest(loads, of) / 1e3);
    let mut rows = vec![
        ["maximum pressure".to_owned(), format!("{:.2} MPa", greatest(loads, |loads| loads.pressure) / 1e6)],
        ["maximum torque".to_owned(), format!("{:.1} N m", greatest(loads, |loads| loads.torque))],
        ["maximum force on the piston pin".to_owned(), kilonewtons(|loads| loads.joints.piston_pin_on_rod.norm())],
        ["maximum force on the crank pin".to_owned(), kilonewtons(|loads| loads.joints.crank_pin_on_rod.norm())],
        ["maximum side force of the piston".to_owned(), kilonewtons(|loads| loads.joints.z_normal.abs())],
    ];
    for machine in machines {
        let [weight, shaft] = machine.masses;
        let bearing = greatest(&machine.loads, |loads| loads.joints.bearing_on_crank.norm());
        let shaking = greatest(&machine.loads, |loads| loads.shaking.norm());
        rows.push([
            format!("{}: counterweight, mass on the shaft", machine.name),
            format!("{weight:.3} kg, {shaft:.3} kg"),
        ]);
        rows.push([
            format!("{}: maximum main bearing, shaking force", machine.name),
            format!("{:.3} kN, {shaking:.0} N", bearing / 1e3),
        ]);
    }
    rows
}
