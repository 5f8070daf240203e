//! Linkages as SVG: a [`Drawing`] of one position, with axes, and with velocities, accelerations and forces to scale; an
//! [`Animation`] of a whole motion, in the same style, with the paths of points; a [`CircuitChart`] of the circuits of a
//! mechanism.
//!
//! ```
//! use linkage_report::drawing::Drawing;
//!
//! let mut drawing = Drawing::new("One bar");
//! drawing.ground("A", [0.0, 0.0]).joint("B", [3.0, 4.0]).bar("A", "B");
//! drawing.velocity_scale(0.5).velocity("B", [-4.0, 3.0]);
//! let svg = drawing.to_svg()?;
//! assert!(svg.starts_with("<svg"));
//! # Ok::<(), linkage_report::drawing::DrawingError>(())
//! ```

mod animation;
mod arrows;
mod axes;
mod circuits;
mod error;
mod figure;
mod film;
mod frame;
mod item;
mod mechanism;
mod names;
mod obstacles;
mod part;
mod parts;
mod pen;
mod plain;
mod render;
mod shapes;
mod smil;
mod stage;
mod still;

pub use animation::Animation;
pub use circuits::CircuitChart;
pub use error::DrawingError;
pub use parts::Parts;
pub use render::Placement;
pub use still::Drawing;
