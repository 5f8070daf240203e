//! Frames of named points and the parts that connect them: the contents of a picture, at rest or in motion.

use nalgebra::Vector2;
use svg::Document;

use super::DrawingError;
use super::part::Part;

/// The contents of a picture.
#[derive(Debug, Clone, Default)]
pub(super) struct Figure {
    pub frames: Vec<Vec<(String, Vector2<f64>)>>,
    pub parts: Vec<Part>,
    /// The first mistake of a call that cannot return it.
    pub mistake: Option<DrawingError>,
    /// The names that were changed, with the new ones, in order.
    pub renamed: Vec<[String; 2]>,
    /// The width of the picture in pixels, if it has one.
    pub width: Option<u32>,
}

impl Figure {
    pub(super) fn part(&mut self, part: Part) {
        self.parts.push(part);
    }

    pub(super) fn link(&mut self, points: &[&str], driven: bool) {
        self.part(Part::Link { points: owned(points), driven });
    }

    pub(super) fn sleeve(&mut self, pin: &str, [from, to]: [&str; 2]) {
        self.part(Part::Sleeve { pin: pin.to_owned(), arm: [from, to].map(str::to_owned) });
    }
}

impl Figure {
    /// An empty picture of this size in its own unit.
    pub(super) fn page(&self, [width, height]: [f64; 2]) -> Document {
        let page = Document::new().set("viewBox", (0, 0, width, height));
        match self.width {
            Some(pixels) => page.set("width", pixels).set("height", f64::from(pixels) * height / width),
            None => page,
        }
    }

    /// Notes a mistake; the first one is reported.
    fn mistaken(&mut self, mistake: DrawingError) {
        self.mistake.get_or_insert(mistake);
    }

    /// The names of all points.
    fn names(&self) -> impl Iterator<Item = &str> {
        self.frames.iter().take(1).flatten().map(|(name, _)| name.as_str())
    }

    /// The mistake of a name that no point has.
    fn unknown(&self, name: &str) -> DrawingError {
        let distance = |other: &&str| letters_apart(name, other);
        // Half the letters may differ, and the case.
        let is_near = |other: &&str| name.eq_ignore_ascii_case(other) || distance(other) <= name.chars().count() / 2;
        let near = self.names().filter(is_near);
        let nearest = near.min_by_key(distance).map(str::to_owned);
        DrawingError::UnknownJoint { name: name.to_owned(), nearest }
    }

    /// Removes the parts that connect exactly these points; a mistake if there are none.
    pub(super) fn without(&mut self, points: &[&str]) {
        if let Some(unknown) = points.iter().find(|point| !self.names().any(|name| name == **point)) {
            self.mistaken(self.unknown(unknown));
            return;
        }
        let count = self.parts.len();
        let connects = |part: &Part| {
            let of_part = part.points();
            of_part.len() == points.len() && points.iter().all(|point| of_part.iter().any(|other| other == point))
        };
        self.parts.retain(|part| points.is_empty() || !connects(part));
        if self.parts.len() == count {
            self.mistaken(DrawingError::NoPart(owned(points)));
        }
    }

    /// Gives a point another name.
    pub(super) fn rename(&mut self, from: &str, to: &str) {
        if !self.names().any(|name| name == from) {
            self.mistaken(self.unknown(from));
            return;
        }
        let points = self.frames.iter_mut().flatten().map(|(name, _)| name);
        let of_parts = self.parts.iter_mut().flat_map(Part::points_mut);
        for name in points.chain(of_parts).filter(|name| *name == from) {
            to.clone_into(name);
        }
        self.renamed.push([from, to].map(str::to_owned));
    }

    /// The name that a point has now.
    pub(super) fn current(&self, name: &str) -> String {
        self.renamed.iter().fold(name.to_owned(), |name, [from, to]| if name == *from { to.clone() } else { name })
    }

    /// Lets these points leave their paths, and no others.
    pub(super) fn trace(&mut self, points: &[&str]) {
        for &point in points {
            if !self.names().any(|name| name == point) {
                self.mistaken(self.unknown(point));
                return;
            }
        }
        for part in &mut self.parts {
            if let Part::Trace(point) = part {
                *part = Part::Point(std::mem::take(point));
            }
        }
        self.parts.retain(|part| !matches!(part, Part::Point(point) if points.contains(&point.as_str())));
        self.parts.extend(points.iter().map(|&point| Part::Trace(point.to_owned())));
    }
}

/// The number of letters to insert, remove or replace to make one name of the other, case aside (Levenshtein, 1966).
fn letters_apart(one: &str, other: &str) -> usize {
    let letters = |name: &str| name.chars().flat_map(char::to_lowercase).collect::<Vec<_>>();
    let (one, other) = (letters(one), letters(other));
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (done, letter) in one.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], done + 1);
        for (place, of_other) in other.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != of_other);
            diagonal = row[place + 1];
            row[place + 1] = replaced.min(diagonal + 1).min(row[place] + 1);
        }
    }
    row[other.len()]
}

pub(super) fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_counted() {
        let pairs = [("A", "a"), ("", "ab"), ("rocker", "rokcer"), ("Tip", "Tap1"), ("kitten", "sitting")];
        assert_eq!(pairs.map(|(one, other)| letters_apart(one, other)), [0, 2, 2, 2, 3]);
    }
}
