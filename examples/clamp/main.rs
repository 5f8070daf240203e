//! Self-locking: a wedge, and a toggle clamp that friction in its pins keeps closed.
//!
//! `cargo run --example clamp` finds the limits by simulation, compares them with closed forms, and writes
//! `target/clamp.html`.

use std::error::Error;

use linkage_examples::output;

mod locking;
mod machine;
mod pictures;

use locking::{stays, toggle, way, wedge};

fn main() -> Result<(), Box<dyn Error>> {
    let (released, _) = wedge(0.3)?;
    let steepest = between([0.05, 1.2], |alpha| Ok(way(alpha, 0.05)? == 0.0))?;
    let expected = released.mu.atan();
    assert!((steepest - expected).abs() < 1e-9, "wedge: {steepest} {expected}");

    // A line that touches the friction circles of the outer pins on one side and that of the knee on the other.
    let (closed, _) = toggle(0.1)?;
    let knee = between([1e-3, 0.5], |theta| stays(theta, 0.0))?;
    let height = closed.mechanism.a * knee.sin();
    let circle = closed.mu.atan().sin() / closed.mu.atan().cos() * closed.radius;
    assert!((height / (2.0 * circle) - 1.0).abs() < 1e-9, "toggle: {height} {circle}");

    let rows = [
        ("coefficient of friction of the wedge", format!("{:.2}", released.mu)),
        ("it locks up to", format!("{:.6}° = atan(mu)", steepest.to_degrees())),
        ("friction in the pins of the toggle, radius", format!("{:.2}, {:.0} mm", closed.mu, closed.radius * 1e3)),
        ("it stays closed up to", format!("{:.6}° of the lever", knee.to_degrees())),
        (
            "height of the knee there",
            format!("{:.6} mm, twice the friction circle of {:.1} mm", height * 1e3, circle * 1e3),
        ),
    ];
    let rows = rows.map(|(name, value)| [name.to_owned(), value]);
    for [name, value] in &rows {
        println!("{name:44} {value}");
    }
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/clamp.html".to_owned());
    let path = output::write(path, &pictures::page([steepest, knee], &rows)?)?;
    println!("Pictures: {path}");
    Ok(())
}

/// The place up to which a condition holds, by bisection.
fn between(
    [mut low, mut high]: [f64; 2],
    holds: impl Fn(f64) -> Result<bool, linkage::Error>,
) -> Result<f64, linkage::Error> {
    for _ in 0..50 {
        let middle = (low + high) / 2.0;
        if holds(middle)? { low = middle } else { high = middle }
    }
    Ok((low + high) / 2.0)
}
