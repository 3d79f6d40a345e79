//! Choosing a file inside the window, since desktops' own choosers are missing where this program is often run.

use std::path::{Path, PathBuf};

use egui::{Key, ScrollArea, TextEdit, Ui};

use super::fields::{name_widget, short_button};
use super::folder::{Listing, has_extension};
use crate::scene::format::FORMATS;
use crate::viewer::state::FilePurpose;
use crate::viewer::text::Words;

/// A folder being looked through and a name being typed.
#[derive(Debug)]
pub struct FileDialog {
    /// `None` once it is closed: only the folder is kept.
    purpose: Option<FilePurpose>,
    /// Absolute.
    folder: PathBuf,
    listing: Listing,
    /// A name in `folder`, a path from there, or an absolute one.
    name: String,
    fault: Option<String>,
    /// A file in the way, until it is said whether to replace it.
    to_replace: Option<PathBuf>,
    /// The name's field takes the focus when the dialog opens.
    is_new: bool,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FileAnswer {
    Path(PathBuf),
    Cancel,
}

fn extensions(purpose: FilePurpose) -> Vec<&'static str> {
    match purpose {
        FilePurpose::Open => FORMATS.iter().filter(|format| format.is_read()).map(|format| format.extension).collect(),
        FilePurpose::Save => {
            FORMATS.iter().filter(|format| format.is_written()).map(|format| format.extension).collect()
        }
        FilePurpose::Screenshot => vec!["png", "exr"],
    }
}

impl FileDialog {
    /// Where the last dialog was, or beside the document, or where the program was started.
    pub fn open(purpose: FilePurpose, own_path: Option<&Path>, last_folder: Option<&Path>, words: &Words) -> Self {
        let beside = own_path.and_then(|path| std::path::absolute(path).ok()?.parent().map(Path::to_owned));
        let folder = last_folder.map(Path::to_owned).or(beside).or_else(|| std::env::current_dir().ok());
        let own_name = own_path.and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        let name = match purpose {
            FilePurpose::Open => String::new(),
            FilePurpose::Save => own_name.unwrap_or_else(|| "scene.toml".to_owned()),
            FilePurpose::Screenshot => {
                let stem = own_path.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
                format!("{}.png", stem.as_deref().unwrap_or("zerkalo"))
            }
        };
        let mut dialog = Self {
            purpose: Some(purpose),
            folder: folder.unwrap_or_default(),
            listing: Listing::default(),
            name,
            fault: None,
            to_replace: None,
            is_new: true,
        };
        dialog.list(words);
        dialog
    }

    pub fn is_open_for(&self, purpose: FilePurpose) -> bool {
        self.purpose == Some(purpose)
    }

    pub fn close(&mut self) {
        self.purpose = None;
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    pub fn show(&mut self, ui: &mut Ui, words: &Words, own_path: Option<&Path>) -> Option<FileAnswer> {
        let purpose = self.purpose?;
        self.show_folder(ui, words);
        let picked = self.show_listing(ui, words);
        let field = ui.add(TextEdit::singleline(&mut self.name).desired_width(f32::INFINITY));
        name_widget(&field, || words.dialogs.file_name.to_owned());
        if std::mem::take(&mut self.is_new) {
            field.request_focus();
        }
        if field.changed() {
            (self.fault, self.to_replace) = (None, None);
        }
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        if let Some(fault) = &self.fault {
            ui.colored_label(ui.visuals().error_fg_color, fault);
        }
        ui.add_space(8.0);
        if self.to_replace.is_some() {
            return self.ask_to_replace(ui, words);
        }
        let (is_accepted, is_cancelled) = ui
            .horizontal(|ui| {
                let accept = if purpose == FilePurpose::Open { words.dialogs.open } else { words.dialogs.save };
                (ui.button(accept).clicked(), ui.button(words.dialogs.cancel).clicked())
            })
            .inner;
        if is_cancelled {
            return Some(FileAnswer::Cancel);
        }
        if is_accepted || is_entered || picked {
            return self.accept(purpose, words, own_path).map(|path| self.leave_with(path));
        }
        None
    }

    fn show_folder(&mut self, ui: &mut Ui, words: &Words) {
        ui.horizontal(|ui| {
            if short_button(ui, "⏶", words.dialogs.folder_up)
                && let Some(parent) = self.folder.parent()
            {
                self.enter(parent.to_owned(), words);
            }
            ui.add(egui::Label::new(self.folder.display().to_string()).truncate());
        });
    }

    /// Whether a file was picked and accepted in one, by clicking it twice.
    fn show_listing(&mut self, ui: &mut Ui, words: &Words) -> bool {
        const LIST_HEIGHT: f32 = 220.0;
        let rows = self.listing.folders.len() + self.listing.files.len();
        let row_height = ui.spacing().interact_size.y;
        let (mut entered, mut picked) = (None, None);
        let area = ScrollArea::vertical().id_salt(&self.folder).max_height(LIST_HEIGHT).auto_shrink([false, true]);
        area.show_rows(ui, row_height, rows, |ui, visible| {
            for row in visible {
                if let Some(folder) = self.listing.folders.get(row) {
                    if ui.selectable_label(false, format!("{folder}/")).clicked() {
                        entered = Some(self.folder.join(folder));
                    }
                } else if let Some(file) = self.listing.files.get(row - self.listing.folders.len()) {
                    let response = ui.selectable_label(self.name == *file, file);
                    if response.clicked() {
                        picked = Some((file.clone(), response.double_clicked()));
                    }
                }
            }
        });
        if self.listing.files.is_empty() {
            ui.weak(words.dialogs.no_files);
        }
        if let Some(folder) = entered {
            self.enter(folder, words);
        }
        let Some((name, is_accepted)) = picked else { return false };
        self.name = name;
        (self.fault, self.to_replace) = (None, None);
        is_accepted
    }

    fn ask_to_replace(&mut self, ui: &mut Ui, words: &Words) -> Option<FileAnswer> {
        ui.label(words.dialogs.replace_question);
        let (replaces, keeps) = ui
            .horizontal(|ui| (ui.button(words.dialogs.replace).clicked(), ui.button(words.dialogs.keep).clicked()))
            .inner;
        let path = if replaces || keeps { self.to_replace.take() } else { None };
        path.filter(|_| replaces).map(|path| self.leave_with(path))
    }

    /// The file that the name stands for, when it will do; a folder is entered.
    fn accept(&mut self, purpose: FilePurpose, words: &Words, own_path: Option<&Path>) -> Option<PathBuf> {
        let dialogs = &words.dialogs;
        let extensions = extensions(purpose);
        let name = self.name.trim();
        let path = self.folder.join(name);
        if !name.is_empty() && path.is_dir() {
            self.name.clear();
            self.enter(path, words);
            return None;
        }
        let path = purpose.completed(path);
        let is_saving = purpose != FilePurpose::Open;
        self.fault = if name.is_empty() {
            Some(dialogs.file_name_missing.to_owned())
        } else if !has_extension(&path, &extensions) {
            let is_picture = purpose == FilePurpose::Screenshot;
            let sentence = if is_picture { dialogs.picture_extension } else { dialogs.scene_extension };
            let named: Vec<_> = extensions.iter().map(|extension| format!(".{extension}")).collect();
            Some(format!("{sentence} {}.", named.join(", ")))
        } else if !is_saving && !path.exists() {
            Some(dialogs.no_such_file.to_owned())
        } else if !path.parent().is_some_and(Path::is_dir) {
            Some(dialogs.no_such_folder.to_owned())
        } else {
            None
        };
        if self.fault.is_some() {
            return None;
        }
        if is_saving && path.exists() && !own_path.is_some_and(|own| is_same_file(own, &path)) {
            self.to_replace = Some(path);
            return None;
        }
        Some(path)
    }

    /// The next dialog begins where this one ended.
    fn leave_with(&mut self, path: PathBuf) -> FileAnswer {
        if let Some(folder) = path.parent() {
            self.folder = folder.to_owned();
        }
        FileAnswer::Path(path)
    }

    fn enter(&mut self, folder: PathBuf, words: &Words) {
        self.folder = folder;
        self.to_replace = None;
        self.list(words);
    }

    fn list(&mut self, words: &Words) {
        let extensions = extensions(self.purpose.unwrap_or(FilePurpose::Open));
        let listing = Listing::read(&self.folder, &extensions);
        self.fault = listing.as_ref().err().map(|error| format!("{} {error}", words.dialogs.folder_unreadable));
        self.listing = listing.unwrap_or_default();
    }
}

/// By whatever names it goes.
fn is_same_file(one: &Path, other: &Path) -> bool {
    matches!((one.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other)
}
