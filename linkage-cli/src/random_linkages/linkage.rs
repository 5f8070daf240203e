//! A linkage as rows of equations, which is written as text, and whose residual and derivatives are computed without that text.

use std::f64::consts::TAU;
use std::fmt::Write as _;

/// A linear form of the coordinates.
#[derive(Debug, Clone, Default)]
pub struct Linear {
    pub terms: Vec<(f64, usize)>,
    pub constant: f64,
}

impl Linear {
    pub fn of(coordinate: usize) -> Self {
        Self { terms: vec![(1.0, coordinate)], constant: 0.0 }
    }

    pub fn number(constant: f64) -> Self {
        Self { terms: Vec::new(), constant }
    }

    pub fn plus(mut self, constant: f64) -> Self {
        self.constant += constant;
        self
    }

    pub fn at(&self, q: &[f64]) -> f64 {
        self.terms.iter().map(|(factor, place)| factor * q[*place]).sum::<f64>() + self.constant
    }

    fn size(&self, q: &[f64]) -> f64 {
        self.terms.iter().map(|(factor, place)| (factor * q[*place]).abs()).sum::<f64>() + self.constant.abs()
    }

    fn text(&self, all: &[Coordinate]) -> String {
        let mut text = String::new();
        for (factor, place) in &self.terms {
            let name = &all[*place].name;
            let sign = if *factor < 0.0 { " - " } else { " + " };
            let factor = if factor.abs() == 1.0 { name.clone() } else { format!("{}*{name}", factor.abs()) };
            text += sign;
            text += &factor;
        }
        if self.constant != 0.0 || self.terms.is_empty() {
            text += if self.constant < 0.0 { " - " } else { " + " };
            text += &self.constant.abs().to_string();
        }
        match text.strip_prefix(" + ") {
            Some(rest) => rest.to_owned(),
            None => text.replacen(" - ", "-", 1),
        }
    }
}

/// A vector of this length at this angle.
#[derive(Debug, Clone)]
pub struct Vector {
    pub length: Linear,
    pub angle: Linear,
}

/// A sum of vectors.
pub type Sum = Vec<Vector>;

pub fn vector(length: f64, angle: Linear) -> Vector {
    Vector { length: Linear::number(length), angle }
}

pub fn negative(sum: &Sum) -> Sum {
    let negative = |of: &Vector| {
        let terms = of.length.terms.iter().map(|(factor, place)| (-factor, *place)).collect();
        Vector { length: Linear { terms, constant: -of.length.constant }, angle: of.angle.clone() }
    };
    sum.iter().map(negative).collect()
}

pub fn place(sum: &Sum, q: &[f64]) -> [f64; 2] {
    sum.iter().fold([0.0; 2], |[x, y], of| {
        let (length, angle) = (of.length.at(q), of.angle.at(q));
        [x + length * angle.cos(), y + length * angle.sin()]
    })
}

/// The derivatives of a sum by each coordinate.
pub fn derivatives(sum: &Sum, q: &[f64]) -> Vec<[f64; 2]> {
    let mut all = vec![[0.0; 2]; q.len()];
    for of in sum {
        let (length, (sin, cos)) = (of.length.at(q), of.angle.at(q).sin_cos());
        for (factor, place) in &of.length.terms {
            all[*place][0] += factor * cos;
            all[*place][1] += factor * sin;
        }
        for (factor, place) in &of.angle.terms {
            all[*place][0] -= factor * length * sin;
            all[*place][1] += factor * length * cos;
        }
    }
    all
}

fn sum_text(sum: &Sum, all: &[Coordinate]) -> String {
    let one = |of: &Vector| {
        let [length, angle] = [&of.length, &of.angle].map(|form| form.text(all));
        let length = if of.length.terms.len() + usize::from(of.length.constant != 0.0) > 1 {
            format!("({length})")
        } else {
            length
        };
        let is_name = angle.chars().all(|letter| letter.is_alphanumeric() || letter == '_' || letter == '.');
        if is_name { format!("{length}@{angle}") } else { format!("{length}@({angle})") }
    };
    sum.iter().map(one).collect::<Vec<_>>().join(" + ").replace("+ -", "- ")
}

fn range_text([least, most]: [f64; 2], is_angle: bool) -> String {
    let unit = if is_angle { "rad" } else { "" };
    format!("{least}{unit}..{most}{unit}")
}

#[derive(Debug, Clone)]
pub enum Row {
    Loop(Sum),
    Equation(Linear),
}

#[derive(Debug, Clone)]
pub struct Coordinate {
    pub name: String,
    pub is_angle: bool,
    pub range: Option<[f64; 2]>,
}

#[derive(Debug, Clone)]
pub enum Form {
    Linear(Linear),
    /// The direction of a vector.
    Angle(Sum),
}

impl Form {
    pub fn at(&self, q: &[f64]) -> f64 {
        match self {
            Self::Linear(form) => form.at(q),
            Self::Angle(sum) => {
                let [x, y] = place(sum, q);
                y.atan2(x)
            }
        }
    }

    fn text(&self, all: &[Coordinate]) -> String {
        match self {
            Self::Linear(form) => form.text(all),
            Self::Angle(sum) => format!("angle({})", sum_text(sum, all)),
        }
    }

    /// The values at positions next to each other, on the turn nearest to the last one.
    pub fn along<'q>(&self, all: impl Iterator<Item = &'q [f64]>) -> Vec<f64> {
        let mut last: Option<f64> = None;
        let next = |q: &[f64]| {
            let mut value = self.at(q);
            if let (Self::Angle(_), Some(last)) = (self, last) {
                value += ((last - value) / TAU).round() * TAU;
            }
            last = Some(value);
            value
        };
        all.map(next).collect()
    }
}

#[derive(Debug, Clone)]
pub struct Output {
    pub name: String,
    pub form: Form,
    pub range: Option<[f64; 2]>,
}

/// Its coordinates are the unknowns, then the inputs.
#[derive(Debug, Clone)]
pub struct Linkage {
    pub family: &'static str,
    pub unknowns: usize,
    pub coordinates: Vec<Coordinate>,
    pub rows: Vec<Row>,
    pub points: Vec<(String, Sum)>,
    pub outputs: Vec<Output>,
    /// A position.
    pub start: Vec<f64>,
}

impl Linkage {
    pub fn text(&self) -> String {
        let declared = |of: &Coordinate| match of.range {
            None => of.name.clone(),
            Some(range) => format!("{} in {}", of.name, range_text(range, of.is_angle)),
        };
        let (unknowns, inputs) = self.coordinates.split_at(self.unknowns);
        let list = |all: &[Coordinate]| all.iter().map(declared).collect::<Vec<_>>().join(", ");
        let mut text = "mechanism M {\n".to_owned();
        let _ = writeln!(text, "    input {};\n    unknown {};", list(inputs), list(unknowns));
        for row in &self.rows {
            let _ = match row {
                Row::Loop(sum) => writeln!(text, "    loop {} = 0;", sum_text(sum, &self.coordinates)),
                Row::Equation(form) => writeln!(text, "    equation {} = 0;", form.text(&self.coordinates)),
            };
        }
        for (name, sum) in &self.points {
            let _ = writeln!(text, "    point {name} = {};", sum_text(sum, &self.coordinates));
        }
        for output in &self.outputs {
            let is_angle = match &output.form {
                Form::Angle(_) => true,
                Form::Linear(form) => form.terms.iter().all(|(_, place)| self.coordinates[*place].is_angle),
            };
            let range = output.range.map(|range| format!(" in {}", range_text(range, is_angle))).unwrap_or_default();
            let _ = writeln!(text, "    output {}{range} = {};", output.name, output.form.text(&self.coordinates));
        }
        text +=
            "    body b { mass 1; inertia 0.5; center P; angle 0; }\n".replace("angle 0", &self.body_angle()).as_str();
        text += "    scene Rest { equilibrium; force (0.3, -1) at P; }\n";
        text += "    scene Fall { inertia; gravity (0, -1); energy; }\n";
        text + "}\n"
    }

    fn body_angle(&self) -> String {
        let angle = self.coordinates.iter().find(|of| of.is_angle);
        format!("angle {}", angle.map_or("0", |of| of.name.as_str()))
    }

    /// The equations, each zero at a position.
    pub fn residual(&self, q: &[f64]) -> Vec<f64> {
        let rows = self.rows.iter().flat_map(|row| match row {
            Row::Loop(sum) => place(sum, q).to_vec(),
            Row::Equation(form) => vec![form.at(q)],
        });
        rows.collect()
    }

    /// For each equation the sum of the sizes of its terms, of which each is wrong by some units in its last place. The argument of
    /// a cosine is one of these terms too.
    pub fn sizes(&self, q: &[f64]) -> Vec<f64> {
        let of_vector = |of: &Vector| of.length.size(q) + of.length.at(q).abs() * (1.0 + of.angle.size(q));
        let rows = self.rows.iter().flat_map(|row| match row {
            Row::Loop(sum) => vec![sum.iter().map(of_vector).sum(); 2],
            Row::Equation(form) => vec![form.size(q)],
        });
        rows.collect()
    }

    /// The derivatives of each equation by each coordinate.
    pub fn jacobian(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let mut all = Vec::new();
        for row in &self.rows {
            match row {
                Row::Loop(sum) => {
                    let of = derivatives(sum, q);
                    all.extend([0, 1].map(|axis| of.iter().map(|both| both[axis]).collect()));
                }
                Row::Equation(form) => {
                    let mut of = vec![0.0; q.len()];
                    form.terms.iter().for_each(|(factor, place)| of[*place] += factor);
                    all.push(of);
                }
            }
        }
        all
    }
}
