//! What is calculated without a device: scenes and their files, plans, the reference, pictures and their files.

#[path = "../budget/mod.rs"]
mod budget;
#[path = "../oracle/mod.rs"]
mod oracle;
#[path = "../random/mod.rs"]
mod random;
#[path = "../scenes/mod.rs"]
mod scenes;

mod compare;
mod frame;
mod plan;
mod plan_bounds;
mod reference_leaving;
mod reference_oracle;
mod reference_pictures;
mod reference_refraction;
mod reference_shading;
mod reference_solids;
mod scene_animation;
mod scene_binary;
mod scene_broken_files;
mod scene_edits;
mod scene_gallery;
mod scene_nff;
mod scene_round_trips;
