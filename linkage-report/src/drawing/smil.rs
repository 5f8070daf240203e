//! The animation as SVG. Every body is drawn once, in its first position, and moved by `animateTransform`; readers who
//! prefer reduced motion see a still copy instead.

use nalgebra::Vector2;
use svg::Document;
use svg::node::element::{AnimateTransform, Description, Group, Path, Rectangle, Style, Text, Title};

use super::DrawingError;
use super::animation::{Animation, Part};
use super::film::{Body, Film, SIZE};
use super::names::{self, Name, Shape};
use super::obstacles;
use super::pen::{Pen, short};
use super::shapes::{BLOCK, block, ground, hatching, link, spring, turning, wheel};

/// Every style rule is limited to this class, so that the picture can be part of a page.
const CLASS: &str = "linkage";
const STYLE: &str = include_str!("animation.css");

/// The colours of links, used in turn.
const COLOURS: [&str; 4] = ["a", "b", "c", "d"];

/// The moments, besides the first, at which names must be clear of other shapes.
const MOMENTS: usize = 72;

/// A shape and its motion.
struct Item {
    body: Body,
    /// The shape around its origin, at the angle of the first frame.
    drawn: Group,
    /// The lengths of a spring, which is drawn along x; empty for other shapes.
    lengths: Vec<f64>,
    /// The name of a joint.
    name: Option<Label>,
}

/// A name next to its point.
struct Label {
    text: String,
    /// Its places relative to the point, at equal steps of time.
    offsets: Vec<Vector2<f64>>,
}

/// The picture under construction.
struct Stage<'a> {
    film: &'a Film,
    /// Shapes at rest, behind all others.
    back: Group,
    items: Vec<Item>,
    /// The number of coloured links so far.
    links: usize,
    /// Points along the arrows: obstacles for names.
    arrows: Vec<[Vector2<f64>; 2]>,
}

impl Animation {
    /// Writes the SVG.
    ///
    /// # Errors
    /// [`DrawingError`] if there is nothing to draw, a name is unknown or used twice, a number is not finite, or the
    /// parts contradict the frames: a link changes its shape, a ground pivot moves, a slider leaves its straight line.
    pub fn to_svg(&self) -> Result<String, DrawingError> {
        if !(self.seconds.is_finite() && self.seconds > 0.0) {
            return Err(DrawingError::NotFinite("the duration of an animation".to_owned()));
        }
        svg(self)
    }
}

fn svg(animation: &Animation) -> Result<String, DrawingError> {
    let film = Film::of(animation)?;
    let mut stage = Stage { film: &film, back: Group::new(), items: Vec::new(), links: 0, arrows: Vec::new() };
    for part in &animation.parts {
        stage.part(part)?;
    }
    stage.joints(animation)?;
    let (mut moving, mut still) = (Group::new().set("class", "moving"), Group::new().set("class", "still"));
    for item in &stage.items {
        moving = moving.add(item.group(Some(animation.seconds)));
        still = still.add(item.group(None));
    }
    let document = Document::new()
        .set("class", CLASS)
        .set("viewBox", (0, 0, SIZE.x, SIZE.y))
        .set("role", "img")
        .add(Title::new(animation.title.as_str()))
        .add(Description::new().add(svg::node::Text::new(describe(animation))))
        .add(Style::new(STYLE))
        .add(Rectangle::new().set("class", "paper").set("width", "100%").set("height", "100%"))
        .add(stage.back)
        .add(moving)
        .add(still);
    Ok(document.to_string())
}

fn describe(animation: &Animation) -> String {
    let traces = animation.parts.iter().filter_map(|part| match part {
        Part::Trace(point) => Some(point.as_str()),
        _ => None,
    });
    let traces: Vec<&str> = traces.collect();
    if traces.is_empty() {
        "A linkage in motion".to_owned()
    } else {
        format!("A linkage in motion, with the path of {}", traces.join(" and of "))
    }
}

fn path(class: &str, d: String) -> Path {
    Path::new().set("class", class).set("d", d)
}

fn hatched(line: &[Vector2<f64>]) -> Path {
    path("hatch", Pen::default().lines(line).path() + &hatching(line))
}

impl Stage<'_> {
    fn part(&mut self, part: &Part) -> Result<(), DrawingError> {
        let film = self.film;
        match part {
            Part::Ground(point) => {
                let [triangle, line] = ground(film.fixed(film.index(point)?)?);
                self.behind([path("hatch", line), path("foot", triangle)]);
            }
            Part::GroundLine(line) => {
                let line: Vec<_> = line.iter().map(|at| film.pixel(*at)).collect();
                self.behind([hatched(&line)]);
            }
            Part::Trace(point) => {
                let track = film.track(film.index(point)?);
                self.behind([path("curve", Pen::default().curve(&track).path())]);
            }
            Part::Link { points, driven } => {
                let (points, body) = self.link(points)?;
                if *driven && points.len() > 1 && film.fixed(points[0]).is_ok() {
                    let ([arc, heads], points) = turning(body.places[0], &body.angles);
                    self.behind([path("arrow", arc), path("head", heads)]);
                    self.arrows.extend(points.windows(2).map(|ends| [ends[0], ends[1]]));
                }
                let colour = if *driven { "drive" } else { self.colour() };
                let outline = link(&self.around(&points));
                self.item(body, colour, [path("link", outline)]);
            }
            Part::Bent(points) => {
                let (points, body) = self.link(points)?;
                let colour = self.colour();
                let bars = Pen::default().lines(&self.around(&points)).path();
                // Three strokes, so that connected bars look like one link.
                self.item(body, colour, ["edge", "core", "tint"].map(|class| path(class, bars.clone())));
            }
            Part::Slider(point) => {
                let index = film.index(point)?;
                let [from, to] = film.guide(index)?;
                let along = (to - from).normalize();
                let [length, width] = [along, Vector2::new(-along.y, along.x)].map(|unit| unit * BLOCK[1]);
                let past = length * 2.5;
                self.behind([hatched(&[from - past + width, to + past + width])]);
                self.item(Body::sliding(film.track(index)), "d", [path("block", block(along))]);
            }
            Part::Sleeve { pin, arm: [from, to] } => {
                let body = film.body(film.index(pin)?, [film.index(from)?, film.index(to)?]);
                let outline = block(body.direction());
                self.item(body, "d", [path("block", outline)]);
            }
            Part::Wheel { centre, towards, radius } => {
                let (centre, towards) = (film.index(centre)?, film.index(towards)?);
                let body = film.body(centre, [centre, towards]);
                let [rim, spokes] = wheel(radius * film.pixels_per_unit, body.direction());
                let colour = self.colour();
                self.item(body, colour, [path("wheel", rim), path("spoke", spokes)]);
            }
            Part::Plate { centre, towards, outline } => {
                let (centre, towards) = (film.index(centre)?, film.index(towards)?);
                let body = film.body(centre, [centre, towards]);
                let x = body.direction() * film.pixels_per_unit;
                let y = Vector2::new(x.y, -x.x);
                let corners: Vec<_> = outline.iter().map(|at| x * at.x + y * at.y).collect();
                let colour = self.colour();
                self.item(body, colour, [path("wheel", Pen::default().lines(&corners).close().path())]);
            }
            Part::Spring([from, to]) => {
                let (from, to) = (film.index(from)?, film.index(to)?);
                let lengths: Vec<f64> = film.frames().iter().map(|frame| (frame[to] - frame[from]).norm()).collect();
                if lengths[0] == 0.0 {
                    let [from, to] = [from, to].map(|point| &film.names()[point]);
                    return Err(DrawingError::NotFinite(format!("the stretch of the spring from `{from}` to `{to}`")));
                }
                let drawn = Group::new().add(path("spring", spring(lengths[0])));
                self.items.push(Item { body: film.body(from, [from, to]), drawn, lengths, name: None });
            }
        }
        Ok(())
    }

    fn behind(&mut self, paths: impl IntoIterator<Item = Path>) {
        self.back = paths.into_iter().fold(std::mem::take(&mut self.back), Group::add);
    }

    fn item(&mut self, body: Body, class: &str, paths: impl IntoIterator<Item = Path>) {
        let drawn = paths.into_iter().fold(Group::new().set("class", class), Group::add);
        self.items.push(Item { body, drawn, lengths: Vec::new(), name: None });
    }

    fn colour(&mut self) -> &'static str {
        self.links += 1;
        COLOURS[(self.links - 1) % COLOURS.len()]
    }

    fn link(&self, names: &[String]) -> Result<(Vec<usize>, Body), DrawingError> {
        let points: Vec<usize> = names.iter().map(|name| self.film.index(name)).collect::<Result<_, _>>()?;
        let body = self.film.link(&points)?;
        Ok((points, body))
    }

    /// The points of the first frame relative to the first of them.
    fn around(&self, points: &[usize]) -> Vec<Vector2<f64>> {
        let frame = &self.film.frames()[0];
        points.iter().map(|point| frame[*point] - frame[points[0]]).collect()
    }

    /// Draws circles at joints, dots at traced points, and the names of both.
    fn joints(&mut self, animation: &Animation) -> Result<(), DrawingError> {
        let film = self.film;
        let (mut met, mut traced) = (vec![0; film.names().len()], vec![false; film.names().len()]);
        for part in &animation.parts {
            for name in part.joints() {
                met[film.index(name)?] += 1;
            }
            if let Part::Trace(point) = part {
                traced[film.index(point)?] = true;
            }
        }
        let named: Vec<usize> = (0..met.len()).filter(|point| met[*point] > 1 || traced[*point]).collect();
        let moments = film.moments(MOMENTS);
        let mut shapes = Vec::new();
        for places in &moments {
            let joints = named.iter().map(|&point| Shape::joint(places[point]));
            let arrows = self.arrows.iter().map(|&ends| Shape::line(ends, 1.0));
            shapes.push(joints.chain(arrows).chain(obstacles::shapes(animation, film, places)?).collect());
        }
        let name = |&point: &usize| Name {
            text: film.names()[point].as_str(),
            at: moments.iter().map(|places| places[point]).collect(),
        };
        let inside = |at: Vector2<f64>| at >= Vector2::repeat(8.0) && at <= SIZE - Vector2::repeat(8.0);
        let names: Vec<Name> = named.iter().map(name).collect();
        let offsets = names::offsets(&names, &shapes, inside);
        for ((&point, name), offsets) in named.iter().zip(names).zip(offsets) {
            let class = if traced[point] { "dot" } else { "joint" };
            let drawn = Group::new().add(path(class, Pen::default().circle(Vector2::zeros(), 4.5).close().path()));
            let name = Some(Label { text: name.text.to_owned(), offsets });
            self.items.push(Item { body: Body::sliding(film.track(point)), drawn, lengths: Vec::new(), name });
        }
        Ok(())
    }
}

impl Label {
    /// The name, which walks around its point in this number of seconds, or stays at its first place.
    fn text(&self, seconds: Option<f64>) -> Text {
        let first = self.offsets[0];
        let text = Text::new(self.text.as_str()).set("x", short(first.x, 1)).set("y", short(first.y + 4.5, 1));
        // Whole pixels, and only the moments between which it walks, keep the file small.
        let walk = |offset: &Vector2<f64>| format!("{} {}", short(offset.x - first.x, 0), short(offset.y - first.y, 0));
        let last = self.offsets.len() - 1;
        let is_kept = |&at: &usize| {
            at == 0
                || at == last
                || self.offsets[at - 1] != self.offsets[at]
                || self.offsets[at] != self.offsets[at + 1]
        };
        let kept: Vec<usize> = (0..=last).filter(is_kept).collect();
        let values = kept.iter().map(|&at| walk(&self.offsets[at])).collect();
        let times: Vec<String> = kept.iter().map(|&at| short(at as f64 / last as f64, 3)).collect();
        let walk = animate("translate", values, seconds).map(|walk| walk.set("keyTimes", times.join(";")));
        walk.into_iter().fold(text, Text::add)
    }
}

/// The animation through values at equal steps of time; none of a picture at rest or of values that do not change.
fn animate(kind: &str, values: Vec<String>, seconds: Option<f64>) -> Option<AnimateTransform> {
    let moves = values.iter().any(|value| *value != values[0]);
    seconds.filter(|_| moves).map(|seconds| {
        AnimateTransform::new()
            .set("attributeName", "transform")
            .set("type", kind)
            .set("dur", format!("{}s", short(seconds, 3)))
            .set("repeatCount", "indefinite")
            .set("values", values.join(";"))
    })
}

impl Item {
    /// The item in its first position, or animated through all frames in this number of seconds.
    fn group(&self, seconds: Option<f64>) -> Group {
        let first = self.body.places[0];
        let mut drawn = self.drawn.clone();
        if let Some(name) = &self.name {
            drawn = drawn.add(name.text(seconds));
        }
        let animate = |kind: &str, values: Vec<String>| animate(kind, values, seconds);
        if let Some(&length) = self.lengths.first() {
            let stretch = self.lengths.iter().map(|now| format!("{} 1", short(now / length, 3))).collect();
            drawn = animate("scale", stretch).into_iter().fold(drawn, Group::add);
            let along = format!("rotate({})", short(self.body.angles[0].to_degrees(), 2));
            drawn = Group::new().add(drawn).set("transform", along);
            drawn = Group::new().add(drawn);
        }
        let place = |at: &Vector2<f64>| format!("{} {}", short(at.x, 1), short(at.y, 1));
        let moves = animate("translate", self.body.places.iter().map(place).collect());
        let angle = |angle: &f64| short((angle - self.body.angles[0]).to_degrees(), 2);
        let turns = animate("rotate", self.body.angles.iter().map(angle).collect());
        // The rotation is applied after the translation, animated or not.
        let turns = turns.map(|turns| turns.set("additive", "sum"));
        let group = drawn.set("transform", format!("translate({})", place(&first)));
        moves.into_iter().chain(turns).fold(group, Group::add)
    }
}
