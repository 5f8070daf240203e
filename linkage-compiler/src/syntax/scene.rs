//! Bodies and scenes.

use proc_macro2::Ident;

use super::expression::ExpressionId;

/// `body NAME { mass m; inertia j; center G; angle phi; }`
pub struct Body {
    pub name: Ident,
    /// The keyword and the value of each property.
    pub properties: Vec<(Ident, ExpressionId)>,
    /// True if it has no syntax error.
    pub is_complete: bool,
}

impl Body {
    /// The value of a property.
    #[must_use]
    pub fn property(&self, word: &str) -> Option<ExpressionId> {
        self.properties.iter().find(|(keyword, _)| keyword == word).map(|(_, value)| *value)
    }
}

/// `scene NAME { … }`, or `scene NAME of DRIVER { … }`.
pub struct Scene {
    pub name: Ident,
    pub of: Option<Ident>,
    pub effects: Vec<Effect>,
    /// True if it has no syntax error.
    pub is_complete: bool,
}

/// One effect of a scene.
pub struct Effect {
    pub keyword: Ident,
    pub kind: EffectKind,
}

/// The kind and the content of an effect.
pub enum EffectKind {
    /// The inertia of these bodies, of all if there are none.
    Inertia(Vec<Ident>),
    Gravity {
        field: ExpressionId,
        bodies: Vec<Ident>,
    },
    Spring {
        stiffness: ExpressionId,
        free: Option<ExpressionId>,
        attachment: Attachment,
    },
    Damper {
        constant: ExpressionId,
        attachment: Attachment,
    },
    Torque {
        law: ExpressionId,
        on: ExpressionId,
    },
    Force {
        law: ExpressionId,
        at: ExpressionId,
    },
    Potential(ExpressionId),
    Friction {
        /// The factors of the largest force.
        factors: Vec<ExpressionId>,
        /// `Some` if the force in the joint is another factor, with the pin if it is named.
        reaction: Option<Option<ExpressionId>>,
        on: ExpressionId,
    },
    Stop {
        on: ExpressionId,
        range: Option<[ExpressionId; 2]>,
        restitution: ExpressionId,
    },
    Drive {
        input: Ident,
        law: ExpressionId,
    },
    /// The force in a pin, or that of a guide.
    Reaction(Joint),
    /// A keyword that adds functions.
    Request,
    /// An effect with a syntax error: its names.
    Unread(ExpressionId),
}

/// A joint of a linkage: a pin at a point, or the guide of a length.
#[derive(Debug, Clone, Copy)]
pub enum Joint {
    At(ExpressionId),
    On(ExpressionId),
}

/// The scalar that a spring or damper acts along: an expression, or the distance of two points.
#[derive(Debug, Clone, Copy)]
pub enum Attachment {
    On(ExpressionId),
    Between(ExpressionId, ExpressionId),
}

/// The words that begin an effect.
pub const EFFECTS: [&str; 15] = [
    "inertia",
    "gravity",
    "spring",
    "damper",
    "torque",
    "force",
    "potential",
    "friction",
    "stop",
    "drive",
    "energy",
    "power",
    "reaction",
    "reactions",
    "equilibrium",
];

/// The words that begin a property of a body.
pub const PROPERTIES: [&str; 4] = ["mass", "inertia", "center", "angle"];
