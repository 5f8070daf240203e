//! The mobility of a mechanism: its links and joints, and the count of its degrees of freedom.

use linkage_runtime::derivation::Derivation;

/// The mobility of a mechanism.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Mobility {
    /// The number of coordinates.
    pub coordinates: usize,
    /// The number of equations between them that are solved.
    pub equations: usize,
    /// The number of equations that are declared as implied by these.
    pub implied: usize,
    /// The degrees of freedom: coordinates less equations. As many inputs drive the mechanism.
    pub degrees_of_freedom: usize,
    /// The links and joints; none if the loops do not show them.
    pub chain: Option<LinksAndJoints>,
}

/// The links and joints of a mechanism, which its loops show, and what they count.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LinksAndJoints {
    /// The names of the links; the ground comes first.
    pub links: Vec<String>,
    /// The number of joints that turn; where k links meet in a pin, there are k - 1.
    pub turning: usize,
    /// The number of joints that slide.
    pub sliding: usize,
    /// The number of loops: j - n + 1 of n links and j joints.
    pub loops: usize,
    /// The number of conditions between coordinates, such as those of gears.
    pub conditions: usize,
    /// The degrees of freedom by the count 3 (n - 1) - 2 j less the conditions (P. L. Chebyshev 1854, M. Grübler 1883,
    /// K. Kutzbach 1929), which sees no dimensions.
    pub count: i64,
    /// The constraints that are redundant: the true degrees of freedom are so many more than the count.
    pub redundant: usize,
}

impl Mobility {
    /// The mobility of the mechanism of a derivation.
    #[must_use]
    pub fn of(derivation: &Derivation<'_>) -> Self {
        let (inputs, unknowns) = (derivation.inputs.len(), derivation.unknowns.len());
        let chain = derivation.chain.map(|chain| {
            let (n, j) = (chain.links.len(), chain.joints.len());
            let sliding = chain.joints.iter().filter(|joint| joint.slides_along.is_some()).count();
            // At most 64 coordinates and their links; a document that was read has any number of conditions.
            let conditions = i64::try_from(chain.conditions).unwrap_or(i64::MAX);
            let count = (3 * (n as i64 - 1) - 2 * j as i64).saturating_sub(conditions);
            LinksAndJoints {
                links: chain.links.iter().map(|link| link.name.to_owned()).collect(),
                turning: j - sliding,
                sliding,
                loops: (j + 1).saturating_sub(n),
                conditions: chain.conditions,
                count,
                redundant: usize::try_from((inputs as i64).saturating_sub(count)).unwrap_or_default(),
            }
        });
        Self {
            coordinates: inputs + unknowns,
            equations: derivation.residual.len(),
            implied: derivation.implied.len(),
            degrees_of_freedom: inputs,
            chain,
        }
    }
}
