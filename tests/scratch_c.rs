#[path = "hard_cases/coincident_joints.rs"]
mod coincident_joints;
