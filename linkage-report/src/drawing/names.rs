//! Placement of names: next to their points, clear of joints, links and one another in every frame.
//!
//! A name stays where it is while it is clear there. Where the motion would cover it, it walks around its point: its places
//! over time are the cheapest path through a few candidates (Viterbi, 1967), by what it covers and how far it walks.

use std::cmp::Reverse;
use std::f64::consts::TAU;

use nalgebra::Vector2;

/// The directions of a name from its point.
const DIRECTIONS: usize = 16;
/// The distances of a name from its point, in pixels: near, or far where points are crowded.
const RINGS: [f64; 2] = [18.0, 30.0];
const CANDIDATES: usize = RINGS.len() * DIRECTIONS;

/// Half the height of a name, and half the width of a letter, in pixels.
const HALF_HEIGHT: f64 = 6.0;
const HALF_LETTER: f64 = 3.7;

/// The room around a name beyond which more is no better, in pixels.
const ROOM: f64 = 6.0;

/// The costs of a frame: a name far from its point; a name out of the picture. Those of what it covers are squares of
/// pixels over [`ROOM`], times the weight of the shape.
const FAR: f64 = 2.0;
const OUTSIDE: f64 = 200.0;
/// The cost of a step to the next direction or ring; that of several in one frame is its square, and more than
/// `LONGEST` would be a jump.
const STEP: f64 = 1.5;
const LONGEST: usize = 2;

/// A shape that a name should not cover: a segment of some thickness.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    pub ends: [Vector2<f64>; 2],
    /// Half its thickness, in pixels.
    pub radius: f64,
    pub weight: f64,
}

impl Shape {
    /// A line or a body that a name had better not cover.
    pub(super) fn line(ends: [Vector2<f64>; 2], radius: f64) -> Self {
        Self { ends, radius, weight: 1.0 }
    }

    /// A line that may be behind a name if there is no other place.
    pub(super) fn faint(ends: [Vector2<f64>; 2]) -> Self {
        Self { ends, radius: 1.0, weight: 0.2 }
    }

    /// The circle of a joint: a name never covers it.
    pub(super) fn joint(at: Vector2<f64>) -> Self {
        Self { ends: [at; 2], radius: 5.5, weight: 30.0 }
    }

    /// The text of a name: no other covers it.
    fn name(text: &str, at: Vector2<f64>) -> Self {
        Self { ends: spine(text, at), radius: HALF_HEIGHT, weight: 12.0 }
    }
}

/// A name and the places of its point in all frames.
pub(super) struct Name<'a> {
    pub text: &'a str,
    pub at: Vec<Vector2<f64>>,
}

/// The sides of the triangle under a ground pivot.
pub(super) fn foot(at: Vector2<f64>) -> [Shape; 3] {
    let [left, right] = [-11.0, 11.0].map(|side| at + Vector2::new(side, 17.0));
    [[at, left], [left, right], [right, at]].map(|ends| Shape::line(ends, 1.0))
}

/// The offsets of all names from their points, in all frames, given the other shapes of each; `inside` is true for
/// positions in the picture. The last offset of a name is its first.
pub(super) fn offsets(
    names: &[Name],
    frames: &[Vec<Shape>],
    inside: impl Fn(Vector2<f64>) -> bool,
) -> Vec<Vec<Vector2<f64>>> {
    let at_rest: Vec<Vec<Costs>> = names
        .iter()
        .map(|name| {
            let frames = name.at.iter().zip(frames);
            frames
                .map(|(at, shapes)| {
                    let [places, shapes] =
                        [places(name.text, *at, &inside), covered(name.text, *at, shapes.iter().copied())];
                    std::array::from_fn(|candidate| places[candidate] + shapes[candidate])
                })
                .collect()
        })
        .collect();
    let mut offsets: Vec<Vec<Vector2<f64>>> = vec![Vec::new(); names.len()];
    let mut order: Vec<usize> = (0..names.len()).collect();
    // Long names first: they are the hardest. Then each once more, now that it sees all others.
    order.sort_by_key(|&place| Reverse(names[place].text.len()));
    for &place in order.iter().chain(&order) {
        let name = &names[place];
        let with_names = at_rest[place].iter().zip(&name.at).enumerate().map(|(frame, (at_rest, at))| {
            let others = names.iter().zip(&offsets).enumerate().filter(|(other, _)| *other != place);
            let others = others.filter_map(|(_, (other, offsets))| {
                offsets.get(frame).map(|offset| Shape::name(other.text, other.at[frame] + offset))
            });
            let others = covered(name.text, *at, others);
            std::array::from_fn(|candidate| at_rest[candidate] + others[candidate])
        });
        let path = cheapest(&with_names.collect::<Vec<Costs>>());
        offsets[place] = path.into_iter().map(|candidate| offset(name.text, candidate)).collect();
    }
    offsets
}

/// The offset of a candidate: those of the near ring come first.
fn offset(text: &str, candidate: usize) -> Vector2<f64> {
    let (ring, direction) = (candidate / DIRECTIONS, candidate % DIRECTIONS);
    // No direction is that of an axis, along which most links and guides are.
    let angle = TAU / DIRECTIONS as f64 * (direction as f64 + 0.5);
    Vector2::new((RINGS[ring] + half_spine(text)) * angle.cos(), -RINGS[ring] * angle.sin())
}

/// A name is a thick horizontal segment; this is half its length without the round ends.
fn half_spine(text: &str) -> f64 {
    (HALF_LETTER * text.chars().count() as f64 - HALF_HEIGHT + 2.0).max(0.0)
}

fn spine(text: &str, at: Vector2<f64>) -> [Vector2<f64>; 2] {
    [-1.0, 1.0].map(|side| at + Vector2::new(side * half_spine(text), 0.0))
}

/// The cost of each candidate in one frame.
type Costs = [f64; CANDIDATES];

/// The costs of the places themselves.
fn places(text: &str, at: Vector2<f64>, inside: impl Fn(Vector2<f64>) -> bool) -> Costs {
    std::array::from_fn(|candidate| {
        let away = if candidate < DIRECTIONS { 0.0 } else { FAR };
        let is_inside = spine(text, at + offset(text, candidate)).into_iter().all(&inside);
        away + if is_inside { 0.0 } else { OUTSIDE }
    })
}

/// The costs of what a name covers.
fn covered(text: &str, at: Vector2<f64>, shapes: impl Iterator<Item = Shape>) -> Costs {
    let half = half_spine(text);
    let reach = |shape: &Shape| half + HALF_HEIGHT + shape.radius + ROOM;
    let near: Vec<Shape> = shapes.filter(|shape| distance(at, shape.ends) < RINGS[1] + half + reach(shape)).collect();
    std::array::from_fn(|candidate| {
        let at = at + offset(text, candidate);
        let ends = spine(text, at);
        // The distance from the middle is quick and excludes most.
        let close = near.iter().filter(|shape| distance(at, shape.ends) < reach(shape));
        let cost = |shape: &Shape| {
            let gap = separation(ends, shape.ends) - HALF_HEIGHT - shape.radius;
            shape.weight * (ROOM - gap).max(0.0).powi(2) / ROOM
        };
        close.map(cost).sum()
    })
}

/// The cheapest path through the candidates of all frames that ends where it begins. It begins at the candidate that
/// costs least in the first frame, which is also the still picture, and on average.
fn cheapest(costs: &[Costs]) -> Vec<usize> {
    let total = |candidate: usize| costs.iter().map(|costs| costs[candidate]).sum::<f64>();
    let whole = |candidate: usize| costs[0][candidate] + total(candidate) / costs.len() as f64;
    let home = least((0..CANDIDATES).map(whole)).0;
    let steps: Vec<Costs> = (0..CANDIDATES).map(|to| std::array::from_fn(|from| walk(from, to))).collect();
    let mut sums = [f64::INFINITY; CANDIDATES];
    sums[home] = costs[0][home];
    let mut before: Vec<[usize; CANDIDATES]> = Vec::new();
    for costs in &costs[1..] {
        let best: [(usize, f64); CANDIDATES] =
            std::array::from_fn(|to| least(sums.iter().zip(&steps[to]).map(|(sum, step)| sum + step)));
        before.push(best.map(|(from, _)| from));
        sums = std::array::from_fn(|to| best[to].1 + costs[to]);
    }
    let mut path = vec![home];
    for before in before.iter().rev() {
        path.push(before[path[path.len() - 1]]);
    }
    path.reverse();
    path
}

/// The first of the least values, and its place.
fn least(values: impl Iterator<Item = f64>) -> (usize, f64) {
    let start = (0, f64::INFINITY);
    values.enumerate().fold(start, |best, (place, value)| if value < best.1 { (place, value) } else { best })
}

/// The cost of a step from one candidate to another.
fn walk(from: usize, to: usize) -> f64 {
    let turn = (from % DIRECTIONS).abs_diff(to % DIRECTIONS);
    let steps = turn.min(DIRECTIONS - turn) + usize::from(from / DIRECTIONS != to / DIRECTIONS);
    if steps > LONGEST { f64::INFINITY } else { STEP * (steps * steps) as f64 }
}

fn distance(point: Vector2<f64>, [from, to]: [Vector2<f64>; 2]) -> f64 {
    let ([x, y], [dx, dy]) = ([point.x - from.x, point.y - from.y], [to.x - from.x, to.y - from.y]);
    let square = dx * dx + dy * dy;
    let fraction = if square > 0.0 { ((x * dx + y * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    (x - dx * fraction).hypot(y - dy * fraction)
}

/// The distance of two segments; zero if they cross.
fn separation(one: [Vector2<f64>; 2], other: [Vector2<f64>; 2]) -> f64 {
    let parts = |[from, to]: [Vector2<f64>; 2], ends: [Vector2<f64>; 2]| {
        let [a, b] = ends.map(|end| (to - from).perp(&(end - from)));
        a * b < 0.0
    };
    if parts(one, other) && parts(other, one) {
        return 0.0;
    }
    let ends = one.map(|end| distance(end, other)).into_iter().chain(other.map(|end| distance(end, one)));
    ends.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }

    /// The gap between a name and what it should not cover, in each frame.
    fn gaps(name: &Name, offsets: &[Vector2<f64>], frames: &[Vec<Shape>]) -> Vec<f64> {
        let gap =
            |at: Vector2<f64>, shape: &Shape| separation(spine(name.text, at), shape.ends) - HALF_HEIGHT - shape.radius;
        let places = name.at.iter().zip(offsets).map(|(at, offset)| at + offset);
        let least =
            |(at, shapes): (_, &Vec<Shape>)| shapes.iter().map(|shape| gap(at, shape)).fold(f64::INFINITY, f64::min);
        places.zip(frames).map(least).collect()
    }

    #[test]
    fn segments_that_cross_have_no_distance() {
        let cross = [point(-1.0, 0.0), point(1.0, 0.0)];
        assert_eq!(separation(cross, [point(0.0, -1.0), point(0.0, 1.0)]), 0.0);
        assert_eq!(separation(cross, [point(0.0, 2.0), point(0.0, 5.0)]), 2.0);
        assert_eq!(separation(cross, [point(4.0, 4.0), point(4.0, -3.0)]), 3.0);
        assert_eq!(separation([point(0.0, 0.0); 2], [point(3.0, 4.0); 2]), 5.0);
    }

    /// A link that turns once around its point sweeps every direction: a name at rest would be covered.
    #[test]
    fn names_walk_before_a_link_that_turns() {
        let steps = 24;
        let at = point(200.0, 200.0);
        let frames: Vec<Vec<Shape>> = (0..=steps)
            .map(|step| TAU * f64::from(step) / f64::from(steps))
            .map(|angle| vec![Shape::joint(at), Shape::line([at, at + point(angle.cos(), angle.sin()) * 90.0], 7.0)])
            .collect();
        let name = Name { text: "A", at: vec![at; frames.len()] };
        let offsets = &offsets(std::slice::from_ref(&name), &frames, |_| true)[0];
        assert_eq!(offsets[0], offsets[frames.len() - 1]);
        assert!(gaps(&name, offsets, &frames).into_iter().all(|gap| gap > 0.0));
    }

    #[test]
    fn names_that_are_clear_do_not_walk() {
        let frames: Vec<Vec<Shape>> = (0..=24_u32)
            .map(|step| point(200.0 + 3.0 * f64::from(step), 200.0))
            .map(|at| vec![Shape::joint(at), Shape::line([at, at + point(0.0, 60.0)], 7.0)])
            .collect();
        let at = frames.iter().map(|shapes| shapes[0].ends[0]).collect();
        let name = Name { text: "Piston", at };
        let offsets = &offsets(std::slice::from_ref(&name), &frames, |_| true)[0];
        assert!(offsets.iter().all(|offset| *offset == offsets[0]));
        assert!(gaps(&name, offsets, &frames).into_iter().all(|gap| gap > 2.0));
    }

    /// Two joints in one place, for which every place costs as much: the second name keeps clear of the first.
    #[test]
    fn names_of_points_that_coincide_are_apart() {
        let at = point(200.0, 200.0);
        let frames = vec![vec![Shape::joint(at)]; 5];
        let names = ["pin", "slot"].map(|text| Name { text, at: vec![at; frames.len()] });
        let offsets = offsets(&names, &frames, |_| true);
        for (name, other) in [(0, 1), (1, 0)] {
            let mut frames = frames.clone();
            for (frame, shapes) in frames.iter_mut().enumerate() {
                shapes.push(Shape::name(names[other].text, names[other].at[frame] + offsets[other][frame]));
            }
            assert!(gaps(&names[name], &offsets[name], &frames).into_iter().all(|gap| gap > 0.0));
        }
    }
}
