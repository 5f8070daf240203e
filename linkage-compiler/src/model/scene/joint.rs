//! The joints whose forces scenes need: `reaction at B`, `reaction on s`, `reactions`, and frictions by reaction.

use std::collections::BTreeSet;

use super::contact::is_coefficient;
use super::{ContactLaw, Scene};
use crate::diagnostics::Region;
use crate::graph::{Node, NodeId, SymbolId};
use crate::ids::SceneId;
use crate::model::links::{GROUND, Links};
use crate::model::mechanism::Mechanism;
use crate::model::opened::{Load, LoadKind, Site};
use crate::model::resolver::Resolver;
use crate::syntax::{ExpressionId, Joint};

/// A joint that a scene names, before the links are known.
#[derive(Debug, Clone)]
pub(in crate::model) struct Wanted {
    region: Region,
    of: WantedOf,
}

#[derive(Debug, Clone)]
enum WantedOf {
    /// The pin at a point, with its name for messages.
    Pin([NodeId; 2], String),
    /// The guide of a length.
    Guide(NodeId),
    All,
    /// The joint in which a friction acts along a scalar: the index of the contact, the scalar, and the pin if it is
    /// named.
    Friction(usize, NodeId, Option<[NodeId; 2]>),
}

impl Wanted {
    pub(super) fn all(region: impl Into<Region>) -> Self {
        Self { region: region.into(), of: WantedOf::All }
    }

    pub(super) fn friction(region: Region, contact: usize, (along, pin): (NodeId, Option<[NodeId; 2]>)) -> Self {
        Self { region, of: WantedOf::Friction(contact, along, pin) }
    }

    /// The contact of a friction by the force of this joint, and the index of its scalar.
    pub(in crate::model) fn of_friction(&self) -> Option<(usize, Region)> {
        match self.of {
            WantedOf::Friction(contact, ..) => Some((contact, self.region)),
            _ => None,
        }
    }
}

impl Resolver<'_> {
    /// Evaluates `reaction at P` or `reaction on s`.
    pub(super) fn joint(&mut self, joint: Joint) -> Option<Wanted> {
        let id = |joint: Joint| -> ExpressionId {
            match joint {
                Joint::At(id) | Joint::On(id) => id,
            }
        };
        let region = self.expressions.region(id(joint));
        let of = match joint {
            Joint::At(id) => {
                let (x, y) = self.vector(id)?;
                let name = self.expressions.as_name(id).map_or("this point".to_owned(), |name| format!("`{name}`"));
                WantedOf::Pin([x, y], name)
            }
            Joint::On(id) => WantedOf::Guide(self.scalar(id)?),
        };
        Some(Wanted { region, of })
    }

    /// Finds the joints that scenes name; reports names of no joint.
    pub(in crate::model) fn joints(&mut self, links: &mut Links, result: &mut Mechanism) -> Vec<(Site, Load)> {
        let mut finder = Finder { resolver: self, links, result, found: Vec::new() };
        for scene in finder.result.scenes.ids() {
            finder.scene(scene);
        }
        finder.found
    }
}

struct Finder<'f, 'a> {
    resolver: &'f mut Resolver<'a>,
    links: &'f mut Links,
    result: &'f mut Mechanism,
    found: Vec<(Site, Load)>,
}

impl Finder<'_, '_> {
    fn scene(&mut self, id: SceneId) {
        let mut loads = Vec::new();
        for Wanted { region, of } in self.result.scenes[id].wanted.clone() {
            match of {
                WantedOf::Pin(position, text) => {
                    let holding = self.links.holding(&mut self.resolver.graph, position);
                    if holding.is_empty() {
                        let message = format!("{text} is fixed in no body and no link: name a point of a link");
                        self.resolver.diagnostics.error(region, message);
                    } else if holding.iter().all(|&link| link == GROUND) {
                        let message = format!(
                            "{text} is fixed in the ground alone, where no link begins or ends: name a point of a link"
                        );
                        self.resolver.diagnostics.error(region, message);
                    }
                    let joint = self.links.hold(position, &holding);
                    for link in holding {
                        loads.push(self.open(Site::Pin { joint, link }));
                    }
                }
                WantedOf::Guide(length) => {
                    let sites = self.guides(length);
                    if sites.is_empty() {
                        let message = "no vector has this length: a guide is a vector `s@phi` or `(s, h)` whose length \
                                       is a coordinate; for a pin write `reaction at P;`";
                        self.resolver.diagnostics.error(region, message);
                    }
                    loads.extend(sites.into_iter().map(|site| self.open(site)).collect::<Vec<_>>());
                }
                WantedOf::All => {
                    let sites: Vec<Site> = self.links.pins().into_iter().chain(self.all_guides()).collect();
                    if sites.is_empty() && self.result.constraints.is_empty() {
                        let message =
                            "there is no joint: write points and centres of bodies as sums of vectors `r@phi`";
                        self.resolver.diagnostics.error(region, message);
                    }
                    loads.extend(sites.into_iter().map(|site| self.open(site)).collect::<Vec<_>>());
                }
                WantedOf::Friction(contact, along, pin) => {
                    let Some(site) = self.bearing(along, pin, region) else { continue };
                    self.without_radius(site, id, contact, region);
                    let load = self.open(site);
                    self.result.scenes[id].contacts[contact].bearing = Some(load);
                }
            }
        }
        loads.sort_unstable();
        loads.dedup();
        self.result.scenes[id].loads = loads;
    }

    fn all_guides(&self) -> Vec<Site> {
        self.links.guides.iter().map(|guide| Site::Guide { ends: guide.ends, block: guide.links[1] }).collect()
    }

    /// The guides whose length is this coordinate, up to sign and a constant.
    fn guides(&mut self, length: NodeId) -> Vec<Site> {
        let graph = &mut self.resolver.graph;
        let mut moving = graph.symbols_of(&[length]).into_iter().filter(|&symbol| self.links.is_coordinate(symbol));
        let (Some(coordinate), None) = (moving.next(), moving.next()) else { return Vec::new() };
        let slope = graph.partial(&[length], coordinate)[0];
        if graph.constant_value(slope).is_none_or(|slope| slope.abs() != 1.0) {
            return Vec::new();
        }
        let guides = self.links.guides.iter().filter(|guide| guide.coordinate == coordinate);
        guides.map(|guide| Site::Guide { ends: guide.ends, block: guide.links[1] }).collect()
    }

    /// The joint in which a friction acts: the guide of a length, or the pin about which one link turns by this angle
    /// relative to another. The force is that on the first link of the difference; the other carries the pin.
    fn bearing(&mut self, along: NodeId, pin: Option<[NodeId; 2]>, region: Region) -> Option<Site> {
        let mut sites = if pin.is_some() { Vec::new() } else { self.guides(along) };
        if sites.is_empty() {
            sites = self.links.pins_of_angle(&mut self.resolver.graph, along);
        }
        if let Some(pin) = pin {
            let pin = self.links.joint(pin);
            sites.retain(|site| matches!(site, Site::Pin { joint, .. } if Some(*joint) == pin));
        }
        match *sites.as_slice() {
            [site] => return Some(site),
            [] => {
                let message = "no joint moves by this scalar: name the length of a guide, the angle of a link that turns \
                               about the ground, or the difference of the angles of two links with a common pin";
                self.resolver.diagnostics.error(region, message);
            }
            _ => {
                let names: Vec<String> = sites.iter().map(|site| self.load(*site).field).collect();
                let message = format!(
                    "several joints move by this scalar ({}): write `reaction at P on …` with the pin",
                    names.join(", ")
                );
                self.resolver.diagnostics.error(region, message);
            }
        }
        None
    }

    /// Reports a friction in a pin whose only factor has the name of a coefficient: its torque needs a radius.
    fn without_radius(&mut self, site: Site, scene: SceneId, contact: usize, region: Region) {
        let ContactLaw::Friction(factors) = &self.result.scenes[scene].contacts[contact].law else { return };
        let (Site::Pin { .. }, &[factor]) = (site, factors.as_slice()) else { return };
        let Node::Symbol(symbol) = *self.resolver.graph.node(factor) else { return };
        let name = self.resolver.graph.symbol_name(symbol).to_owned();
        if is_coefficient(&name) {
            let message = format!(
                "the torque of friction in a pin is the force times a radius: write `friction {name}, radius, reaction`"
            );
            self.resolver.diagnostics.error(region, message);
        }
    }

    /// The index of the load of a site, which is added at its first use.
    fn open(&mut self, site: Site) -> usize {
        if let Some(known) = self.found.iter().position(|(other, _)| *other == site) {
            return known;
        }
        let mut load = self.load(site);
        let taken: BTreeSet<String> = self.found.iter().flat_map(|(_, other)| other.fields()).collect();
        let (first, mut number) = (load.field.clone(), 1);
        while load.fields().iter().any(|field| taken.contains(field)) {
            number += 1;
            load.field = format!("{first}_{number}");
        }
        self.found.push((site, load));
        self.found.len() - 1
    }

    fn load(&mut self, site: Site) -> Load {
        let (at, normal) = match site {
            Site::Pin { joint, .. } => (self.links.position(joint), None),
            Site::Guide { ends, .. } => {
                let guide = self.links.guides.iter().find(|guide| guide.ends == ends);
                (self.links.position(ends[1]), guide.map(|guide| guide.normal))
            }
        };
        let (field, kind) = match site {
            Site::Pin { joint, link } => {
                let (joint, field) = self.name_of(joint);
                let link = self.links.link(link).name.clone();
                (format!("{field}_on_{link}"), LoadKind::Pin { joint, link })
            }
            Site::Guide { ends, block } => {
                let guide = self.links.guides.iter().find(|guide| guide.ends == ends);
                let base = guide.map_or(GROUND, |guide| guide.links[0]);
                let coordinate = guide.map(|guide| self.resolver.graph.symbol_name(guide.coordinate).to_owned());
                let coordinate = coordinate.unwrap_or_default();
                let [guide, block] = [base, block].map(|link| self.links.link(link).name.clone());
                let end = self.point_at(ends[1]).map(|(text, _)| text);
                (coordinate.clone(), LoadKind::Guide { coordinate, guide, block, end })
            }
        };
        let graph = &mut self.resolver.graph;
        // No identifier has a blank.
        let displacement = [1, 2].map(|at| graph.symbol(format!("displacement {at} of {field}")));
        let left_out = self.equations_of(site);
        Load { field, kind, at, normal, displacement, is_determined: true, left_out }
    }

    /// The equations in the angles of the links of a joint, and in the length of a guide.
    fn equations_of(&self, site: Site) -> Vec<NodeId> {
        let graph = &self.resolver.graph;
        let mut moving: BTreeSet<SymbolId> = BTreeSet::new();
        match site {
            Site::Pin { joint, .. } => {
                moving.extend(self.links.at(joint).flat_map(|link| self.links.turns(graph, link)))
            }
            Site::Guide { ends, .. } => {
                for guide in self.links.guides.iter().filter(|guide| guide.ends == ends) {
                    moving.insert(guide.coordinate);
                    moving.extend(guide.links.iter().flat_map(|&link| self.links.turns(graph, link)));
                }
            }
        }
        let rows = self.result.constraints.iter().filter(|constraint| constraint.rows.len() == 1);
        let rows = rows.flat_map(|constraint| &constraint.rows);
        let touched = rows.filter(|&&row| graph.symbols_of(&[row]).iter().any(|symbol| moving.contains(symbol)));
        touched.copied().collect()
    }

    /// The name of the declared point at a joint, as written and as a field.
    fn point_at(&self, joint: usize) -> Option<(String, String)> {
        let mut points = self.result.points.iter();
        let point = points.find(|point| self.links.joint([point.x, point.y]) == Some(joint))?;
        Some((point.name.text.clone(), point.name.field.clone()))
    }

    /// The name of a joint: that of a point there, the origin, or the links that meet there.
    fn name_of(&mut self, joint: usize) -> (String, String) {
        if let Some(named) = self.point_at(joint) {
            return named;
        }
        if self.links.is_origin(&mut self.resolver.graph, joint) {
            return ("the origin".to_owned(), "origin".to_owned());
        }
        let links: Vec<&str> = self.links.at(joint).map(|link| self.links.link(link).name.as_str()).collect();
        (format!("the joint of {}", links.join(" and ")), links.join("_"))
    }
}

impl Scene {
    /// The region of the friction by reaction that is this contact.
    pub(crate) fn friction_at(&self, contact: usize) -> Option<Region> {
        let mut frictions = self.wanted.iter().filter_map(Wanted::of_friction);
        frictions.find(|(index, _)| *index == contact).map(|(_, region)| region)
    }

    /// The loads that the scene shows or needs for its frictions, as indices of those of the mechanism.
    #[must_use]
    pub fn opened(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self.loads.clone();
        all.extend(self.contacts.iter().filter_map(|contact| contact.bearing));
        all.sort_unstable();
        all.dedup();
        all
    }
}
