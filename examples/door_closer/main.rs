//! A door with a closer: it is released, closes, slows down, latches, and bounces until it rests.
//!
//! `cargo run --example door_closer` prints the events and the energy balance, and writes `target/door_closer.html`.

use std::error::Error;

mod pictures;

use linkage_examples::door_closer::closing::Run;
use linkage_examples::door_closer::machine::Closing;
use linkage_examples::output;

fn main() -> Result<(), Box<dyn Error>> {
    let run = Run::new(Closing::default(), 100_f64.to_radians())?;
    let rows = report(&run);
    for [name, value] in &rows {
        println!("{name:32} {value}");
    }
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/door_closer.html".to_owned());
    let path = output::write(path, &pictures::page(&run, &rows)?)?;
    println!("Pictures: {path}");
    Ok(())
}

fn report(run: &Run) -> Vec<[String; 2]> {
    let last = run.moments[run.moments.len() - 1];
    let joules = |energy: f64| format!("{energy:.9} J");
    let mut rows = vec![["released at".to_owned(), format!("{:.0}°", run.moments[0].q.door.to_degrees())]];
    for impact in &run.impacts[..5] {
        let speed = -impact.rates.door;
        rows.push([format!("hits the frame at {:.6} s", impact.t), format!("with {speed:.6} rad/s")]);
    }
    let rest = run.impacts[run.impacts.len() - 1];
    rows.push(["impacts before rest".to_owned(), run.impacts.len().to_string()]);
    rows.push([format!("rests at {:.6} s", rest.t), format!("last rate {:.1e} rad/s", -rest.rates.door)]);
    rows.push([
        format!("at {} s", last.t),
        format!("{:.1e}°, {} rad/s", last.q.door.to_degrees(), last.rates.door.abs()),
    ]);
    let [before, after] = [run.energies[0], run.energies[run.energies.len() - 1]];
    rows.push(["energy released by the spring".to_owned(), joules(before - after)]);
    rows.push(["dissipated by the damper".to_owned(), joules(run.oil)]);
    rows.push(["dissipated by impacts".to_owned(), joules(run.blows)]);
    let gap = before - after - run.oil - run.blows;
    assert!(gap.abs() < 1e-9 * (before - after), "energy error {gap:e} J");
    rows.push(["relative error of the balance".to_owned(), format!("{:.1e}", gap.abs() / (before - after))]);
    rows
}
