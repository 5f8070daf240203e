//! The gallery: classic mechanisms in motion on one page, with their coupler curves.
//!
//! `cargo run --example gallery` writes `target/gallery.html` for any browser, without network or script. Each picture
//! consists of positions that `assemble` computes in closed form on the given branch; each position is checked, and that no
//! name covers a joint or another name.

use std::error::Error;

#[macro_use]
mod figure;
mod names;
mod page;

mod cams;
mod machines;
mod several_loops;
mod sliders;
mod straight_lines;
mod wheels;

use figure::Figure;
use linkage_examples::output;

/// A family of mechanisms.
pub struct Family {
    pub name: &'static str,
    pub figures: Vec<Figure>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let families = [
        Family { name: "Straight lines", figures: straight_lines::figures()? },
        Family { name: "Sliders", figures: sliders::figures()? },
        Family { name: "Four, five, six and eight bars", figures: several_loops::figures()? },
        Family { name: "Gears, wheels and the Maltese cross", figures: wheels::figures()? },
        Family { name: "Cams", figures: cams::figures()? },
        Family { name: "Machines", figures: machines::figures()? },
    ];
    let figures: Vec<&Figure> = families.iter().flat_map(|family| &family.figures).collect();
    let pictures: Vec<String> = figures.iter().map(|figure| figure.picture.to_svg()).collect::<Result<_, _>>()?;
    let html = page::html(&families, &pictures);
    let path = std::env::args().nth(1).unwrap_or_else(|| "target/gallery.html".to_owned());
    let path = output::write(path, &html)?;

    println!("Gallery: {path}, {} pictures, {} kB", figures.len(), html.len() / 1000);
    assert!(figures.len() >= 30);
    for (figure, picture) in figures.into_iter().zip(&pictures) {
        let size = picture.len();
        println!("{:>6.1} kB  {:.1} ulps  {}", size as f64 / 1000.0, figure.ulps, figure.name);
        names::check(figure.name, picture);
        assert!(size < 28_000, "the picture of {} has {size} bytes", figure.name);
    }
    Ok(())
}
