//! The parts of a picture as shapes. Every body is drawn once, in its first position.

use nalgebra::Vector2;
use svg::node::element::{Group, Path};

use super::DrawingError;
use super::figure::Figure;
use super::film::{Body, Film, Guide};
use super::frame::View;
use super::item::{Item, Label};
use super::names::{self, Name, Shape};
use super::obstacles;
use super::part::Part;
use super::pen::Pen;
use super::shapes::{BLOCK, block, ground, hatching, link, spring, turning, wheel};

/// Every style rule is limited to this class, so that the picture can be part of a page.
pub(super) const CLASS: &str = "linkage";
pub(super) const STYLE: &str = include_str!("linkage.css");

/// The colours of links, used in turn.
const COLOURS: [&str; 4] = ["a", "b", "c", "d"];

/// The moments, besides the first, at which names must be clear of other shapes.
const MOMENTS: usize = 72;

/// The shapes of a picture.
pub(super) struct Shapes {
    /// Those at rest, behind all others.
    pub back: Group,
    pub items: Vec<Item>,
    /// The points that are in the picture, in lengths of the mechanism.
    pub shown: Vec<Vector2<f64>>,
    pub view: View,
}

impl Shapes {
    /// Draws a figure in the view that `fit` chooses; names keep clear of `others`, given in lengths of the mechanism.
    pub(super) fn of(
        figure: &Figure,
        fit: impl Fn(&[Vector2<f64>]) -> View,
        others: &[[Vector2<f64>; 2]],
    ) -> Result<Self, DrawingError> {
        let (film, shown) = Film::of(figure, fit)?;
        let mut stage = Stage { film: &film, back: Group::new(), items: Vec::new(), links: 0, arrows: Vec::new() };
        for part in &figure.parts {
            stage.part(part)?;
        }
        stage.arrows.extend(others.iter().map(|ends| ends.map(|end| film.view.pixel(end))));
        stage.joints(figure)?;
        let Stage { back, items, .. } = stage;
        Ok(Self { back, items, shown, view: film.view })
    }
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
                let line: Vec<_> = line.iter().map(|at| film.view.pixel(*at)).collect();
                self.behind([hatched(&line)]);
            }
            Part::Trace(point) => {
                let track = film.track(film.index(point)?);
                if track.len() > 1 {
                    self.behind([path("curve", Pen::default().curve(&track).path())]);
                }
            }
            Part::Path(points) => {
                let points: Vec<_> = points.iter().map(|at| film.view.pixel(*at)).collect();
                self.behind([path("curve", Pen::default().curve(&points).path())]);
            }
            Part::Joint(point) | Part::Point(point) => _ = film.index(point)?,
            Part::Room(_) => {}
            Part::Link { points, driven } => {
                let (points, body) = self.link(points)?;
                let is_moving = film.frames().len() > 1;
                if *driven && is_moving && points.len() > 1 && film.fixed(points[0]).is_ok() {
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
            Part::Slider { point, along } => {
                let index = film.index(point)?;
                let Guide { ends: [from, to], along } = film.guide(index, *along)?;
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
                let [rim, spokes] = wheel(radius * film.view.pixels_per_unit, body.direction());
                let colour = self.colour();
                self.item(body, colour, [path("wheel", rim), path("spoke", spokes)]);
            }
            Part::Plate { centre, towards, outline } => {
                let (centre, towards) = (film.index(centre)?, film.index(towards)?);
                let body = film.body(centre, [centre, towards]);
                let x = body.direction() * film.view.pixels_per_unit;
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

    /// Draws circles at joints, dots at other points, and the names of both.
    fn joints(&mut self, figure: &Figure) -> Result<(), DrawingError> {
        let film = self.film;
        let (mut met, mut dots) = (vec![0; film.names().len()], vec![false; film.names().len()]);
        for part in &figure.parts {
            for name in part.joints() {
                met[film.index(name)?] += 1;
            }
            match part {
                Part::Trace(point) | Part::Point(point) => dots[film.index(point)?] = true,
                Part::Joint(point) => met[film.index(point)?] += 2,
                _ => {}
            }
        }
        let named: Vec<usize> = (0..met.len()).filter(|point| met[*point] > 1 || dots[*point]).collect();
        let moments = film.moments(MOMENTS);
        let mut shapes = Vec::new();
        for places in &moments {
            let joints = named.iter().map(|&point| Shape::joint(places[point]));
            let arrows = self.arrows.iter().map(|&ends| Shape::line(ends, 1.0));
            shapes.push(joints.chain(arrows).chain(obstacles::shapes(figure, film, places)?).collect());
        }
        let name = |&point: &usize| Name {
            text: film.names()[point].as_str(),
            at: moments.iter().map(|places| places[point]).collect(),
        };
        let names: Vec<Name> = named.iter().map(name).collect();
        let offsets = names::offsets(&names, &shapes, |at| film.view.has_room_at(at));
        for ((&point, name), offsets) in named.iter().zip(names).zip(offsets) {
            let class = if dots[point] { "dot" } else { "joint" };
            let drawn = Group::new().add(path(class, Pen::default().circle(Vector2::zeros(), 4.5).close().path()));
            let name = Some(Label { text: name.text.to_owned(), offsets });
            self.items.push(Item { body: Body::sliding(film.track(point)), drawn, lengths: Vec::new(), name });
        }
        Ok(())
    }
}
