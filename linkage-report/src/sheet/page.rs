//! Writes the page, section by section.

use std::fmt;

use crate::Notation;
use crate::document::outline::{self, GeneralEquation, Lines, counts};
use crate::document::sheet;
use linkage_runtime::derivation::{
    Derivation, Equation, Formula, FormulaMatrix, Kernel, Quantity, Root, SheetDerivation,
};

use crate::words::{Words, capitalised};

use super::html::{display, escape, inline, matrix, svg_address};
use super::{Picture, RatioNumber, RatioProperty, Sheet, Table, Values, at, lines, numbers};

const STYLE: &str = include_str!("style.css");

/// The body of the page and the number of the last equation.
pub(super) struct Page {
    pub(super) words: &'static Words,
    body: String,
    equations: usize,
    /// The numbers below formulas.
    values: Option<Values>,
}

pub(super) fn html(sheet: &Sheet<'_>) -> String {
    let title = escape(sheet.title.as_deref().unwrap_or(sheet.derivation.mechanism));
    document_in(sheet.language.words().tag, &title, &body(sheet))
}

/// The content of the page.
pub(super) fn body(sheet: &Sheet<'_>) -> String {
    let derivation = &sheet.derivation;
    let words = sheet.language.words();
    let mut page = Page { words, body: String::new(), equations: 0, values: sheet.values.clone() };
    page.header(sheet);
    if derivation.unknowns.is_empty() {
        page.section(words.open_chain, |page| page.lead(words.lead_open_chain));
    } else {
        page.constraints(derivation);
        page.jacobian(derivation);
        page.structure(derivation);
        page.ratios(derivation);
        page.acceleration(derivation);
        page.requests(derivation);
    }
    page.properties(derivation, &sheet.properties);
    if let Some(by_hand) = &sheet.by_hand {
        page.by_hand(by_hand);
    }
    page.quantities(words.points, derivation.points);
    page.quantities(words.outputs, derivation.outputs);
    for scene in &sheet.scenes {
        page.scene(scene);
    }
    page.numbers(derivation, &sheet.tables);
    page.pictures(&sheet.pictures);
    page.operations(None, derivation.kernels);
    for scene in &sheet.scenes {
        page.operations(Some(scene.scene), scene.kernels);
    }
    page.conditions(&sheet.conditions());
    page.body
}

/// An English page with this title and this body, both HTML.
pub(crate) fn document(title: &str, body: &str) -> String {
    document_in("en", title, body)
}

fn document_in(language: &str, title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"{language}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n"
    )
}

impl Page {
    pub(super) fn push(&mut self, html: &str) {
        self.body.push_str(html);
        self.body.push('\n');
    }

    pub(super) fn section(&mut self, heading: &str, write: impl FnOnce(&mut Self)) {
        self.push(&format!("<section>\n<h2>{heading}</h2>"));
        write(self);
        self.push("</section>");
    }

    pub(super) fn lead(&mut self, words: &str) {
        self.push(&format!("<p>{words}</p>"));
    }

    /// An equation without a number.
    pub(super) fn general_equation(&mut self, general: &GeneralEquation) {
        self.push(&format!("<div class=\"law\">{}</div>", display(general.mathml, general.latex)));
    }

    pub(super) fn equations(&mut self, equations: &[Equation<'_>]) {
        self.numbered(equations, |page, equation| {
            if let Some(value) = page.values.as_mut().and_then(|values| values.define(equation)) {
                page.at(&equation.left, &format!("<mn>{}</mn>", page.words.number(value)));
            }
        });
    }

    /// Equations with their numbers, each followed by what a function adds.
    fn numbered(&mut self, equations: &[Equation<'_>], after: impl Fn(&mut Self, &Equation<'_>)) {
        if equations.is_empty() {
            return;
        }
        self.push("<div class=\"equations\">");
        for equation in equations {
            self.equations += 1;
            let latex = format!("{} = {}", equation.left.to_latex(), equation.right.to_latex());
            let formula = display(&lines::equation(equation), &latex);
            let number = self.equations;
            self.push(&format!(
                "<div class=\"equation\" id=\"equation-{number}\">{formula}<span class=\"number\">({number})</span></div>"
            ));
            after(self, equation);
        }
        self.push("</div>");
    }

    /// The number of a formula at the position.
    fn at(&mut self, left: &Formula<'_>, number: &str) {
        self.push(&format!("<p class=\"at\"><math>{}<mo>=</mo>{number}</math></p>", left.to_mathml()));
    }

    fn matrix(&mut self, which: &FormulaMatrix<'_>, general: Option<&GeneralEquation>) {
        let lines: String = matrix(which, general).iter().map(|(mathml, latex)| display(mathml, latex)).collect();
        self.push(&format!("<div class=\"law\">{lines}</div>"));
        if let Some(numbers) = self.values.as_ref().and_then(|values| at::matrix(self.words, which, values)) {
            self.push(&format!("<div class=\"at\">{numbers}</div>"));
        }
    }

    fn header(&mut self, sheet: &Sheet<'_>) {
        let derivation = &sheet.derivation;
        let (over, title) = match &sheet.title {
            Some(title) => (escape(derivation.mechanism), escape(title)),
            None => (self.words.kinematics.to_owned(), escape(derivation.mechanism)),
        };
        self.push(&format!("<header>\n<p class=\"over\">{over}</p>\n<h1>{title}</h1>"));
        for paragraph in &sheet.about {
            self.lead(&escape(paragraph));
        }
        self.push("<dl class=\"coordinates\">");
        for (role, symbols) in sheet.roles() {
            let symbols = symbols.iter().map(|(formula, value)| {
                let value =
                    value.map_or_else(String::new, |value| format!("<mo>=</mo><mn>{}</mn>", self.words.number(value)));
                format!("<math>{}{value}</math>", formula.to_mathml())
            });
            let symbols = symbols.collect::<Vec<_>>().join(", ");
            self.push(&format!("<div><dt>{role}</dt><dd>{symbols}</dd></div>"));
        }
        let counts = derivation.counts();
        self.push(&format!("<div><dt>{}</dt><dd>{counts}</dd></div>", self.words.counts));
        self.push("</dl>\n</header>");
    }

    fn constraints(&mut self, derivation: &Derivation<'_>) {
        self.section(self.words.constraints, |page| {
            page.lead(page.words.lead_constraints);
            page.general_equation(&outline::CONSTRAINTS);
            page.numbered(derivation.residual, |_, _| ());
            if !derivation.implied.is_empty() {
                page.lead(page.words.lead_implied);
                page.equations(derivation.implied);
            }
        });
    }

    fn jacobian(&mut self, derivation: &Derivation<'_>) {
        self.section(self.words.jacobian, |page| {
            page.lead(page.words.lead_jacobian);
            page.matrix(&derivation.jacobian_unknowns, Some(&outline::JACOBIAN_UNKNOWNS));
            page.matrix(&derivation.jacobian_inputs, Some(&outline::JACOBIAN_INPUTS));
        });
    }

    fn structure(&mut self, derivation: &Derivation<'_>) {
        let groups = derivation.groups;
        if groups.is_empty() {
            return;
        }
        self.section(self.words.structure, |page| {
            for (index, group) in groups.iter().enumerate() {
                let links = group.equations.iter().map(|row| format!("<a href=\"#equation-{0}\">({0})</a>", row + 1));
                let links = links.collect::<Vec<_>>().join(", ");
                page.push("<article class=\"group\">");
                if groups.len() > 1 {
                    page.push(&format!("<h3>{} {}</h3>", page.words.group, index + 1));
                }
                let kind = escape(&capitalised(&(page.words.kind)(group)));
                let solved = (page.words.solved)(group.equations.len(), &links, &list(group.unknowns.iter()));
                page.push(&format!("<p class=\"kind\">{kind}</p><p>{solved}</p>"));
                page.lead(if group.position.is_empty() { page.words.lead_newton } else { page.words.lead_position });
                page.equations(group.position);
                if let Some(Root { formula, branches }) = &group.root {
                    let [positive, negative] = branches.map(|branch| format!("<code>{}</code>", escape(branch)));
                    page.lead(&(page.words.branches)(&inline(formula), [&positive, &negative]));
                }
                page.lead(&(page.words.system)(group.method));
                page.equations(group.determinant.as_slice());
                if let Some(inverse) = &group.inverse {
                    page.matrix(inverse, None);
                }
                page.push("</article>");
            }
            if let (Some(determinant), [_, _, ..]) = (derivation.determinant, groups) {
                page.lead(page.words.lead_determinant);
                page.equations(&[determinant]);
            }
        });
    }

    fn ratios(&mut self, derivation: &Derivation<'_>) {
        self.section(self.words.ratios, |page| {
            page.lead(page.words.lead_ratios);
            page.general_equation(&outline::RATIOS);
            page.lead(page.words.lead_velocity);
            page.general_equation(&outline::VELOCITY);
            if derivation.inputs.len() == 1 {
                page.lead(page.words.lead_transmission);
            }
            page.equations(derivation.ratios);
        });
    }

    /// The properties of the velocity ratios, each with a table of its numbers.
    fn properties(&mut self, derivation: &Derivation<'_>, properties: &[RatioProperty]) {
        if properties.is_empty() {
            return;
        }
        self.section(self.words.properties, |page| {
            for (index, RatioProperty { statement, numbers: all }) in properties.iter().enumerate() {
                page.push(&format!("<article>\n<p>{}. {}</p>", index + 1, escape(page.words.statement(statement))));
                if !all.is_empty() {
                    let Words { by_ratios, otherwise, .. } = page.words;
                    page.push(&format!(
                        "<div class=\"scroll\">\n<table class=\"operations\">\n<thead><tr><th></th>\
                         <th scope=\"col\">{by_ratios}</th><th scope=\"col\">{otherwise}</th></tr></thead>\n<tbody>",
                    ));
                    for RatioNumber { name, by_ratios, otherwise } in all {
                        let name = numbers::name(derivation, name);
                        let [by_ratios, otherwise] = [by_ratios, otherwise].map(|value| page.words.number(*value));
                        page.push(&format!(
                            "<tr><th scope=\"row\">{name}</th><td>{by_ratios}</td><td>{otherwise}</td></tr>"
                        ));
                    }
                    page.push("</tbody>\n</table>\n</div>");
                }
                page.push("</article>");
            }
        });
    }

    fn by_hand(&mut self, by_hand: &SheetDerivation<'_>) {
        let mut number = self.equations;
        let mut sections = Sections { page: self, is_open: false };
        // A page takes every line.
        let _ = sheet::write(by_hand, &mut sections, &mut number);
        if sections.is_open {
            self.push("</section>");
        }
    }

    fn acceleration(&mut self, derivation: &Derivation<'_>) {
        self.section(self.words.acceleration, |page| {
            page.lead(page.words.lead_acceleration);
            page.general_equation(&outline::ACCELERATION);
            if !derivation.gamma.is_empty() {
                page.lead(page.words.lead_gamma);
            }
            page.equations(derivation.gamma);
        });
    }

    /// The derivatives that the mechanism requests beyond acceleration.
    fn requests(&mut self, derivation: &Derivation<'_>) {
        if let Some(formulas) = derivation.ratio_derivatives {
            self.section(self.words.ratio_derivatives, |page| {
                page.lead(page.words.lead_ratio_derivatives);
                page.general_equation(&outline::RATIO_DERIVATIVES);
                page.equations(formulas);
            });
        }
        if let Some(eta) = derivation.jerk {
            self.section(self.words.jerk, |page| {
                page.lead(page.words.lead_jerk);
                page.general_equation(&outline::JERK);
                page.lead(page.words.lead_eta);
                page.equations(eta);
            });
        }
        if let Some(sensitivity) = derivation.sensitivity {
            self.section(self.words.sensitivity, |page| {
                page.lead(page.words.lead_sensitivity);
                page.general_equation(&outline::SENSITIVITY);
                page.lead(page.words.lead_parameters);
                page.matrix(&sensitivity.jacobian, None);
                page.equations(sensitivity.formulas);
            });
        }
    }

    fn quantities(&mut self, heading: &str, quantities: &[Quantity<'_>]) {
        if quantities.is_empty() {
            return;
        }
        self.section(heading, |page| {
            for quantity in quantities {
                page.push(&format!("<article>\n<h3><code>{}</code></h3>", escape(quantity.name)));
                page.equations(quantity.value);
                page.equations(quantity.ratios);
                page.equations(quantity.ratio_derivatives);
                page.equations(quantity.sensitivities);
                page.push("</article>");
            }
        });
    }

    fn numbers(&mut self, derivation: &Derivation<'_>, tables: &[Table]) {
        if tables.is_empty() {
            return;
        }
        self.section(self.words.numbers, |page| {
            page.push("<div class=\"tables\">");
            for Table { caption, rows } in tables {
                let values = rows.iter().map(|(_, value)| page.words.number(*value)).collect();
                page.push(&format!("<table>\n<caption>{}</caption>\n<tbody>", escape(caption.text(page.words))));
                for ((name, _), value) in rows.iter().zip(numbers::column(values)) {
                    let name = numbers::name(derivation, name);
                    page.push(&format!("<tr><th scope=\"row\">{name}</th><td>{value}</td></tr>"));
                }
                page.push("</tbody>\n</table>");
            }
            page.push("</div>");
        });
    }

    fn pictures(&mut self, pictures: &[Picture]) {
        if pictures.is_empty() {
            return;
        }
        self.section(if pictures.len() == 1 { self.words.picture } else { self.words.pictures }, |page| {
            for Picture { svg, caption } in pictures {
                let (address, caption) = (svg_address(svg), escape(caption));
                page.push(&format!(
                    "<figure>\n<img alt=\"{caption}\" src=\"{address}\">\n<figcaption>{caption}</figcaption>\n</figure>"
                ));
            }
        });
    }

    fn operations(&mut self, scene: Option<&str>, kernels: &[Kernel<'_>]) {
        if kernels.is_empty() {
            return;
        }
        let of = scene.map_or_else(String::new, |scene| format!(": <code>{}</code>", escape(scene)));
        self.section(&format!("{}{of}", self.words.operations), |page| {
            page.lead(page.words.lead_operations);
            let mut rows = String::new();
            for kernel in kernels {
                let cells: String = counts(&kernel.operations).iter().map(|count| format!("<td>{count}</td>")).collect();
                let function = escape(kernel.function);
                rows.push_str(&format!("<tr><th scope=\"row\"><code>{function}</code></th>{cells}</tr>\n"));
            }
            let columns = ["sin, cos, √", "÷", "×", "±"].into_iter().zip(page.words.operation_counts());
            let head: String = columns
                .map(|(sign, name)| format!("<th scope=\"col\"><abbr title=\"{name}\">{sign}</abbr></th>"))
                .collect();
            page.push(&format!(
                "<div class=\"scroll\">\n<table class=\"operations\">\n<thead><tr><th scope=\"col\">{}</th>{head}</tr></thead>\n\
                 <tbody>\n{rows}</tbody>\n</table>\n</div>",
                page.words.function
            ));
        });
    }

    fn conditions(&mut self, conditions: &[&Formula<'_>]) {
        if conditions.is_empty() {
            return;
        }
        self.section(self.words.conditions, |page| {
            let condition = |condition: &&Formula<'_>| page.words.formula(condition, inline(condition));
            let conditions = conditions.iter().map(condition).collect::<Vec<_>>().join(", ");
            page.push(&format!("<p>{} {conditions}.</p>", page.words.lead_conditions));
        });
    }
}

/// Writes an analysis by hand as sections, with numbers below formulas.
struct Sections<'p> {
    page: &'p mut Page,
    is_open: bool,
}

impl Lines for Sections<'_> {
    fn words(&self) -> &'static Words {
        self.page.words
    }

    fn heading(&mut self, heading: &str) -> fmt::Result {
        if self.is_open {
            self.page.push("</section>");
        }
        self.is_open = true;
        self.page.push(&format!("<section>\n<h2>{}</h2>", escape(heading)));
        Ok(())
    }

    fn lead(&mut self, words: &str) -> fmt::Result {
        self.page.lead(&escape(words));
        Ok(())
    }

    fn general_equation(&mut self, general: &GeneralEquation) -> fmt::Result {
        self.page.general_equation(general);
        Ok(())
    }

    fn display(&mut self, formula: &Formula<'_>) -> fmt::Result {
        self.page.push(&format!("<p>{}</p>", inline(formula)));
        Ok(())
    }

    fn equation(&mut self, _: usize, equation: &Equation<'_>) -> fmt::Result {
        self.page.equations(&[*equation]);
        Ok(())
    }

    fn sum(&mut self, _: usize, equation: &Equation<'_>, of: &[&FormulaMatrix<'_>]) -> fmt::Result {
        self.page.numbered(&[*equation], |_, _| ());
        if let Some(sum) = self.page.values.as_ref().and_then(|values| values.sum(of)) {
            let [x, y] = sum.map(|value| self.page.words.number(value));
            self.page.at(&equation.left, &format!("<mo>(</mo><mn>{x}</mn><mo>,</mo><mn>{y}</mn><mo>)</mo>"));
        }
        Ok(())
    }

    fn matrix(&mut self, matrix: &FormulaMatrix<'_>) -> fmt::Result {
        self.page.matrix(matrix, None);
        Ok(())
    }
}

/// Formulas in a line, separated by commas.
pub(super) fn list<'a>(formulas: impl Iterator<Item = &'a Formula<'a>>) -> String {
    formulas.map(inline).collect::<Vec<_>>().join(", ")
}
