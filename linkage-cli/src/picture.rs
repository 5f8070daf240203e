//! Pictures of pixels: PNG of an SVG, GIF of a film of them.

use std::sync::Arc;

use gif::{Encoder, EncodingError, Frame, Repeat};
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Family, Query};
use resvg::usvg::{Options, Tree};

use crate::failure::Failure;

/// Pixels for each unit of an SVG: sharp on a screen of high density, and in a page.
pub const SHARP: f32 = 2.0;

/// Families that stand for `sans-serif` where the system names none.
const FAMILIES: [&str; 6] = ["Arial", "Helvetica", "Liberation Sans", "DejaVu Sans", "Noto Sans", "Segoe UI"];

/// The speed of the search for colours, from 1, best, to 30; pictures of few colours need no search.
const SPEED: i32 = 10;

/// The most pixels of a film, which takes minutes to paint; one of the usual size and number of frames has 50 million.
const MOST_PIXELS: u64 = 1_000_000_000;

/// Frames of a GIF for each second: browsers slow down those of less than 20 milliseconds.
pub const MOST_FRAMES: f64 = 50.0;

/// A painter with the fonts of this system.
pub struct Painter {
    options: Options<'static>,
    scale: f32,
}

impl Painter {
    /// A painter of pictures of this number of pixels for each unit.
    pub fn new(scale: f32) -> Self {
        let mut fonts = Database::new();
        fonts.load_system_fonts();
        let has = |fonts: &Database, family| fonts.query(&Query { families: &[family], ..Query::default() }).is_some();
        if !has(&fonts, Family::SansSerif) {
            let known = FAMILIES.into_iter().find(|family| has(&fonts, Family::Name(family)));
            let any = || fonts.faces().find_map(|face| face.families.first()).map(|(name, _)| name.clone());
            if let Some(family) = known.map(str::to_owned).or_else(any) {
                fonts.set_sans_serif_family(family);
            }
        }
        Self { options: Options { fontdb: Arc::new(fonts), ..Options::default() }, scale }
    }

    /// True if no font is found, so that names are left out.
    pub fn is_without_fonts(&self) -> bool {
        self.options.fontdb.is_empty()
    }

    /// The pixels of an SVG.
    fn pixels(&self, svg: &str) -> Result<Pixmap, String> {
        let tree = Tree::from_str(svg, &self.options).map_err(|error| error.to_string())?;
        let size = tree.size().to_int_size().scale_by(self.scale).ok_or("the picture is too large")?;
        let mut pixels = Pixmap::new(size.width(), size.height()).ok_or("the picture is too large")?;
        // The last row may be a part of one.
        pixels.fill(Color::WHITE);
        resvg::render(&tree, Transform::from_scale(self.scale, self.scale), &mut pixels.as_mut());
        Ok(pixels)
    }

    /// An SVG as PNG.
    pub fn png(&self, svg: &str) -> Result<Vec<u8>, String> {
        self.pixels(svg)?.encode_png().map_err(|error| error.to_string())
    }

    /// Frames as GIF, which takes this number of seconds and begins again at its end.
    pub fn gif(&self, frames: impl ExactSizeIterator<Item = String>, seconds: f64) -> Result<Vec<u8>, Failure> {
        let count = frames.len();
        let unwritten = |error: EncodingError| Failure::Outside(error.to_string());
        // The end of a frame, in hundredths of a second from the first one: its own length, rounded, would make the film
        // longer or shorter.
        let time = |frame: usize| (100.0 * seconds * frame as f64 / count as f64).round();
        let mut film: Option<(Encoder<Vec<u8>>, Pixmap)> = None;
        for (index, svg) in frames.enumerate() {
            let pixels = self.pixels(&svg).map_err(Failure::Outside)?;
            let [width, height] = [pixels.width(), pixels.height()];
            if count as u64 * u64::from(width) * u64::from(height) > MOST_PIXELS {
                let million = MOST_PIXELS / 1_000_000;
                return Err(Failure::Argument(format!(
                    "{count} frames of {width} by {height} pixels are more than {million} million: write a smaller --width or --steps"
                )));
            }
            let mut frame = match &film {
                Some((_, last)) => part(&pixels, changed(last, &pixels)),
                None => part(&pixels, [0, 0, pixels.width() as usize, pixels.height() as usize]),
            };
            frame.delay = (time(index + 1) - time(index)) as u16;
            let mut encoder = match film {
                Some((encoder, _)) => encoder,
                None => endless([frame.width, frame.height]).map_err(unwritten)?,
            };
            encoder.write_frame(&frame).map_err(unwritten)?;
            film = Some((encoder, pixels));
        }
        let (encoder, _) = film.ok_or_else(|| Failure::Outside("the film has no frames".to_owned()))?;
        encoder.into_inner().map_err(unwritten)
    }
}

/// An empty film that begins again at its end.
fn endless([width, height]: [u16; 2]) -> Result<Encoder<Vec<u8>>, EncodingError> {
    let mut encoder = Encoder::new(Vec::new(), width, height, &[])?;
    encoder.set_repeat(Repeat::Infinite)?;
    Ok(encoder)
}

/// The smallest rectangle that holds all changes: left, top, width, height.
fn changed(last: &Pixmap, now: &Pixmap) -> [usize; 4] {
    let (width, height) = (now.width() as usize, now.height() as usize);
    let is_new = |x: usize, y: usize| {
        let pixel = 4 * (width * y + x)..4 * (width * y + x + 1);
        last.data()[pixel.clone()] != now.data()[pixel]
    };
    let rows: Vec<usize> = (0..height).filter(|&y| (0..width).any(|x| is_new(x, y))).collect();
    let [Some(&top), Some(&bottom)] = [rows.first(), rows.last()] else { return [0, 0, 1, 1] };
    let has_new = |x: &usize| (top..=bottom).any(|y| is_new(*x, y));
    let left = (0..width).find(has_new).unwrap_or_default();
    let right = (0..width).rev().find(has_new).unwrap_or(left);
    [left, top, right + 1 - left, bottom + 1 - top]
}

/// A rectangle of a picture as a frame. The picture is opaque.
fn part(pixels: &Pixmap, [left, top, width, height]: [usize; 4]) -> Frame<'static> {
    let rows = pixels.data().chunks_exact(4 * pixels.width() as usize).skip(top).take(height);
    let mut rgba: Vec<u8> = rows.flat_map(|row| &row[4 * left..4 * (left + width)]).copied().collect();
    let frame = Frame::from_rgba_speed(width as u16, height as u16, &mut rgba, SPEED);
    Frame { left: left as u16, top: top as u16, ..frame }
}
