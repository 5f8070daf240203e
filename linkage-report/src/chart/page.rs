//! A page of charts.

use super::{Chart, Polar, STYLE};
use crate::sheet::{document, escape};

/// Additions to the style of sheets.
const OF_PAGE: &str = include_str!("page.css");

/// Charts under headings, as one HTML file, which loads nothing and runs no script.
///
/// ```
/// use linkage::chart::{Axis, Chart, Page};
///
/// let chart = Chart::new("height", Axis::linear("time [s]"), Axis::linear("[m]")).curve("z", [[0.0, 1.0], [1.0, 0.2]]);
/// let mut page = Page::new("Fall", "Simulation");
/// page.section("Motion").lines.push("It touches the ground after 1.2 s.".to_owned());
/// page.section("Heights").chart(&chart);
/// assert!(page.to_html().contains("<h2>Heights</h2>"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// The title.
    pub name: String,
    /// A word above it: the kind of the page.
    pub over: String,
    /// The sections, from top to bottom.
    pub sections: Vec<Section>,
}

/// Lines of text and charts under a heading.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// The heading.
    pub heading: String,
    /// Paragraphs above the charts.
    pub lines: Vec<String>,
    charts: Vec<Drawn>,
}

/// A chart of a section.
#[derive(Debug, Clone, PartialEq)]
enum Drawn {
    Chart(Box<Chart>),
    Polar(Polar),
}

impl Page {
    /// A page without sections.
    #[must_use]
    pub fn new(name: impl Into<String>, over: impl Into<String>) -> Self {
        Self { name: name.into(), over: over.into(), sections: Vec::new() }
    }

    /// Adds an empty section, and returns it.
    pub fn section(&mut self, heading: impl Into<String>) -> &mut Section {
        let section = Section { heading: heading.into(), lines: Vec::new(), charts: Vec::new() };
        self.sections.push(section);
        let last = self.sections.len() - 1;
        &mut self.sections[last]
    }

    /// The page as a file.
    #[must_use]
    pub fn to_html(&self) -> String {
        let (name, over) = (escape(&self.name), escape(&self.over));
        let header = format!("<header>\n<p class=\"over\">{over}</p>\n<h1>{name}</h1>\n</header>\n");
        let sections: String = self.sections.iter().map(Section::to_html).collect();
        let style = format!("{STYLE}{OF_PAGE}");
        document(&name, &format!("<style>{style}</style>\n<div class=\"charted\">\n{header}{sections}</div>\n"))
    }
}

impl Section {
    /// Adds a chart.
    pub fn chart(&mut self, chart: &Chart) {
        self.charts.push(Drawn::Chart(Box::new(chart.clone())));
    }

    /// Adds a chart of vectors.
    pub fn polar(&mut self, chart: &Polar) {
        self.charts.push(Drawn::Polar(chart.clone()));
    }

    /// Its charts as SVG, for pages of another form.
    #[must_use]
    pub fn to_svgs(&self) -> Vec<String> {
        let each = self.charts.iter().map(|chart| match chart {
            Drawn::Chart(chart) => chart.to_svg(),
            Drawn::Polar(chart) => chart.to_svg(),
        });
        each.collect()
    }

    fn to_html(&self) -> String {
        let lines: String = self.lines.iter().map(|line| format!("<p>{}</p>\n", escape(line))).collect();
        let svg = |chart: &Drawn| match chart {
            Drawn::Chart(chart) => chart.to_svg_fragment(),
            Drawn::Polar(chart) => chart.to_svg_fragment(),
        };
        let charts: String = self.charts.iter().map(|chart| format!("<figure>{}</figure>\n", svg(chart))).collect();
        let charts = if charts.is_empty() { charts } else { format!("<div class=\"charts\">\n{charts}</div>\n") };
        format!("<section>\n<h2>{}</h2>\n{lines}{charts}</section>\n", escape(&self.heading))
    }
}
