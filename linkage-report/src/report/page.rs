//! A report as an HTML page.

use linkage_runtime::BorrowedName;

use super::Report;
use super::prose::{MODES, OUTPUTS, Section, sections, written};
use super::{MotionReport, QuantityReport};
use crate::sheet::{document, escape, svg_address};

/// The width and the height of a curve, in its own unit.
const SIZE: [f64; 2] = [480.0, 120.0];

impl<N: BorrowedName> Report<N> {
    /// The report as one HTML file, which loads nothing and runs no script; the outputs have curves.
    #[must_use]
    pub fn to_html(&self) -> String {
        self.to_html_with(&[])
    }

    /// The report as one HTML file, with a picture of each mode as SVG; an empty one where a mode has none.
    #[must_use]
    pub fn to_html_with(&self, pictures: &[String]) -> String {
        let name = escape(&self.mechanism);
        let body = self.body(pictures);
        document(&name, &format!("<header>\n<p class=\"over\">Report</p>\n<h1>{name}</h1>\n</header>\n{body}"))
    }

    /// The sections of the page alone, to be part of another.
    #[must_use]
    pub fn to_html_fragment(&self) -> String {
        self.to_html_fragment_with(&[])
    }

    /// The sections of the page alone, with a picture of each mode as SVG; an empty one where a mode has none.
    #[must_use]
    pub fn to_html_fragment_with(&self, pictures: &[String]) -> String {
        self.body(pictures)
    }

    fn body(&self, pictures: &[String]) -> String {
        let mut body = String::new();
        for Section { heading, paragraphs } in sections(self) {
            body.push_str(&format!("<section>\n<h2>{heading}</h2>\n"));
            let curves = self.motion.as_ref().filter(|_| heading == OUTPUTS);
            let outputs = curves.into_iter().flat_map(|motion| motion.quantities.iter().filter(|one| one.is_output));
            let mut outputs = outputs.map(|output| (output, self.motion.as_ref()));
            for paragraph in paragraphs {
                body.push_str(&format!("<p>{}</p>\n", escape(&paragraph)));
                if let Some((output, Some(motion))) = outputs.next()
                    && !output.is_constant
                {
                    body.push_str(&self.curve(output, motion));
                }
            }
            if heading == MODES && !pictures.is_empty() {
                let figures: String = pictures.iter().zip(1..).map(|(svg, number)| picture(svg, number)).collect();
                body.push_str(&format!("<div class=\"pictures\">\n{figures}</div>\n"));
            }
            body.push_str("</section>\n");
        }
        body
    }

    /// The curve of a quantity over the input, with its dwells shaded.
    fn curve(&self, quantity: &QuantityReport, motion: &MotionReport<N>) -> String {
        let ([low, high], extremes) = (motion.range, quantity.extremes);
        let (least, largest) = (extremes.least.value, extremes.largest.value);
        let [width, height] = SIZE;
        let along = |input: f64| width * (input - low) / (high - low);
        let up =
            |value: f64| if largest > least { height * (largest - value) / (largest - least) } else { height / 2.0 };
        let points = quantity.curve.iter().map(|&[input, value]| format!("{:.1},{:.1}", along(input), up(value)));
        let points = points.collect::<Vec<_>>().join(" ");
        let length = high - low;
        let parts = quantity.dwells.iter().flat_map(|dwell| {
            let beyond = (dwell.to > high).then_some([low, dwell.to - length]);
            [[dwell.from, dwell.to.min(high)]].into_iter().chain(beyond)
        });
        let dwells: String = parts
            .map(|[from, to]| {
                let (x, wide) = (along(from), along(to) - along(from));
                format!("<rect class=\"dwell\" x=\"{x:.1}\" y=\"0\" width=\"{wide:.1}\" height=\"{height}\"></rect>")
            })
            .collect();
        let input = self.inputs.first();
        let is_angle = input.is_some_and(|input| input.is_angle);
        let name = input.map_or("", |input| &input.name);
        let [from, to] = motion.range.map(|input| written(input, is_angle));
        let caption = escape(&format!("{} over {name} from {from} to {to}", quantity.name));
        format!(
            "<figure class=\"curve\">\n<svg viewBox=\"-4 -4 {} {}\" role=\"img\" aria-label=\"{caption}\">{dwells}\
             <polyline points=\"{points}\"></polyline></svg>\n<figcaption>{caption}</figcaption>\n</figure>\n",
            width + 8.0,
            height + 8.0,
        )
    }
}

/// The picture of a mode, or that it has none.
fn picture(svg: &str, number: usize) -> String {
    if svg.is_empty() {
        return format!("<figure>\n<figcaption>Mode {number} has no picture</figcaption>\n</figure>\n");
    }
    format!(
        "<figure>\n<img alt=\"Mode {number}\" src=\"{}\">\n<figcaption>Mode {number}</figcaption>\n</figure>\n",
        svg_address(svg)
    )
}
