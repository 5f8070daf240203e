//! The loops of a group and its unknowns.

/// The loops of a group: k_i + sum_j c_ij t_j = 0, where t_j is a direction cos + i sin and each number is complex,
/// [real, imaginary].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loops<T, const L: usize, const N: usize> {
    /// k_i, by loop.
    pub constants: [[T; 2]; L],
    /// c_ij, by loop and direction.
    pub factors: [[[T; 2]; N]; L],
}

/// An unknown of a group with lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unknown<T> {
    /// An angle. The direction in its place turns with this unknown, or with an integer combination of all angles.
    Angle,
    /// A length along a guide, in one loop only. The factors of its direction are zero.
    Length {
        /// The loop, from 0.
        in_loop: usize,
        /// d: the length s adds s d, or s d t_j, to the loop.
        along: [T; 2],
        /// j: the direction with which the guide turns, `None` if its direction is given.
        with: Option<usize>,
    },
}
