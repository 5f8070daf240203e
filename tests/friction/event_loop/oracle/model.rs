//! A mechanism for the oracle: constant masses, forces, links that always hold, and contacts.

/// The most coordinates.
pub const N: usize = 4;
/// The most links and contacts.
pub const R: usize = 10;

/// Coordinates, rates or forces; those that a model does not have are zero.
pub type Vector = [f64; N];
/// A matrix over the coordinates.
pub type Square = [[f64; N]; N];

/// A scalar s(t, x): s' = `gradient` x' + `drift`, s'' = `gradient` x'' + `bias`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Row {
    pub value: f64,
    pub gradient: Vector,
    pub drift: f64,
    pub bias: f64,
}

/// The scalars of the links, then those of the contacts.
pub type Rows = [Row; R];

/// The law of a contact.
#[derive(Debug, Clone, Copy)]
pub enum Law {
    Friction { limit: f64 },
    Stop { lower: f64, upper: f64, restitution: f64 },
}

/// A mechanism M x'' = F + forces of links and contacts, with constant M.
pub trait Model {
    /// The number of coordinates.
    const COUNT: usize;
    /// The number of links, scalars that stay zero.
    const LINKS: usize = 0;

    fn mass(&self) -> Square;
    fn forces(&self, t: f64, x: &Vector, v: &Vector) -> Vector;
    fn rows(&self, t: f64, x: &Vector, v: &Vector) -> Rows;
    /// The laws of the contacts: contact i has row `LINKS` + i.
    fn laws(&self) -> Vec<Law>;
    /// The coordinates and rates of the scene.
    fn observed(&self, t: f64, x: &Vector, v: &Vector) -> (Vec<f64>, Vec<f64>);
    /// The size of lengths, of time, and the longest step: in it no event function has two extrema.
    fn scales(&self) -> Scales;
}

/// The sizes to which rounding errors are relative, and the longest step.
#[derive(Debug, Clone, Copy)]
pub struct Scales {
    pub length: f64,
    pub time: f64,
    pub step: f64,
}

/// A linear scalar.
pub fn row(value: f64, gradient: &[f64]) -> Row {
    let mut row = Row { value, ..Row::default() };
    row.gradient[..gradient.len()].copy_from_slice(gradient);
    row
}

pub fn rows(given: &[Row]) -> Rows {
    let mut rows = Rows::default();
    rows[..given.len()].copy_from_slice(given);
    rows
}

pub fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
}

impl Row {
    /// s'.
    pub fn rate(&self, v: &Vector) -> f64 {
        dot(&self.gradient, v) + self.drift
    }
}
