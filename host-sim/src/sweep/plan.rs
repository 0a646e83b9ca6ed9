//! The sweep file: from TOML to scenes, axes and a design, and to any point of it. A point is a function of the file and its
//! index alone, so that shards and continuations agree.

use std::path::{Path, PathBuf};

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Deserialize;
use serde::de::IgnoredAny;
use stiction_scene::{InputError, SceneFile, Source};
use toml::de::{DeTable, DeValue, ValueDeserializer};
use toml::{Spanned, Table, Value};

use super::axis::{Axis, one_of};
use super::key::{self, Key};
use crate::settings::Settings;
use stiction_live::scenes;

/// Maximum number of points of a sweep.
pub(super) const MOST: u64 = 1_000_000_000;

/// The file as TOML; `vary` is read separately, for the order and the positions of its keys.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    scenes: Spanned<Vec<Spanned<String>>>,
    #[serde(rename = "vary")]
    _vary: Option<IgnoredAny>,
    design: Option<Design>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Design {
    random: Spanned<u64>,
    #[serde(default)]
    seed: u64,
}

#[derive(Clone, Debug)]
pub(super) struct BaseScene {
    /// Its name in the sweep file.
    pub(super) name: String,
    pub(super) source: Source,
    pub(super) table: Table,
}

#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) source: Source,
    pub(super) scenes: Vec<BaseScene>,
    pub(super) axes: Vec<Axis>,
    seed: Option<u64>,
    points: u64,
}

#[derive(Clone, Debug)]
pub(super) struct GridPoint<'a> {
    pub(super) index: u64,
    pub(super) scene: &'a BaseScene,
    pub(super) values: Vec<Value>,
}

impl Plan {
    /// Reads a sweep file and its scenes.
    pub(super) fn read(file: &Path) -> Result<Self, InputError> {
        let source = Source::read(file)?;
        let document: Document = source.toml()?;
        let scenes = base_scenes(&source, &document)?;
        let axes = axes(&source, document.design.is_none())?;
        let points = match &document.design {
            Some(design) => Some(*design.random.get_ref()),
            None => (axes.iter().map(Axis::count)).try_fold(scenes.len() as u64, u64::checked_mul),
        };
        if points.is_none_or(|points| points == 0 || points > MOST) {
            let count = points.map_or("more than can be counted".to_owned(), |n| n.to_string());
            let problem = format!("the points are {count}, allowed: 1 to {MOST}");
            return Err(match &document.design {
                Some(design) => source.error_at(design.random.span().start, problem),
                None => source.error(problem),
            });
        }
        let plan = Self {
            seed: document.design.map(|design| design.seed),
            points: points.unwrap_or_default(),
            source,
            scenes,
            axes,
        };
        plan.check_places()?;
        Ok(plan)
    }

    pub(super) fn count(&self) -> u64 {
        self.points
    }

    pub(super) fn folder(&self) -> &Path {
        self.source.file().parent().unwrap_or(Path::new(""))
    }

    /// A point; in a grid the scene changes slowest and the last key fastest.
    pub(super) fn point(&self, index: u64) -> GridPoint<'_> {
        let (scene, values) = match self.seed {
            Some(seed) => {
                // Every point has its own stream of random bits.
                let mut random = ChaCha8Rng::seed_from_u64(seed);
                random.set_stream(index);
                let scene = one_of(self.scenes.len(), &mut random);
                let values = self.axes.iter().map(|axis| axis.draw(&mut random));
                (scene, values.collect())
            }
            None => {
                let mut rest = index;
                let digit = |axis: &Axis| {
                    let k = rest % axis.count();
                    rest /= axis.count();
                    axis.at(k)
                };
                let mut values: Vec<Value> = self.axes.iter().rev().map(digit).collect();
                values.reverse();
                (rest as usize, values)
            }
        };
        GridPoint {
            index,
            scene: &self.scenes[scene],
            values,
        }
    }

    /// Checks that every scene has a place for every key.
    fn check_places(&self) -> Result<(), InputError> {
        let point = self.point(0);
        for scene in &self.scenes {
            let (mut table, mut settings) = (scene.table.clone(), Settings::default());
            for (axis, value) in self.axes.iter().zip(&point.values) {
                let set = axis
                    .key
                    .set(value, self.folder(), &mut table, &mut settings);
                set.map_err(|problem| {
                    let (key, name) = (axis.key.name(), &scene.name);
                    let problem = format!("`{key}` cannot be varied: scene {name:?} {problem}");
                    self.source.error_at(axis.offset, problem)
                })?;
            }
        }
        Ok(())
    }

    /// All input files: the sweep file, scenes that are not bundled ones, recorded paths of the hand.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        let scenes = self
            .scenes
            .iter()
            .map(|scene| self.folder().join(&scene.name));
        let mut files = vec![self.source.file().to_owned()];
        files.extend(scenes.chain(self.hand_files()));
        files
    }

    /// The recorded paths of the hand that rows may follow.
    pub(super) fn hand_files(&self) -> Vec<PathBuf> {
        let given = self.axes.iter().filter(|axis| axis.key.is_hand());
        let given = given
            .flat_map(Axis::texts)
            .map(|name| self.folder().join(name));
        let own = self.scenes.iter().filter_map(|scene| {
            let name = scene.table.get("hand")?.get("path")?.as_str()?;
            Some(scene.source.file().parent()?.join(name))
        });
        given.chain(own).collect()
    }
}

impl GridPoint<'_> {
    /// The scene with this point's values, and the settings of its run.
    pub(super) fn scene_file(&self, plan: &Plan) -> Result<(SceneFile, Settings), InputError> {
        let (mut table, mut settings) = (self.scene.table.clone(), Settings::default());
        let source = &self.scene.source;
        for (axis, value) in plan.axes.iter().zip(&self.values) {
            (axis
                .key
                .set(value, plan.folder(), &mut table, &mut settings))
            .map_err(|problem| source.error(problem))?;
        }
        let text = toml::to_string(&table).map_err(|error| source.error(error))?;
        let scene = SceneFile::parse(Source::new(source.file(), text), settings.number.limit())?;
        Ok((scene, settings))
    }
}

fn base_scenes(source: &Source, document: &Document) -> Result<Vec<BaseScene>, InputError> {
    let names = document.scenes.get_ref();
    if names.is_empty() {
        let place = document.scenes.span().start;
        return Err(source.error_at(place, "`scenes` is empty, allowed: at least one"));
    }
    let folder = source.file().parent().unwrap_or(Path::new(""));
    let scene = |given: &Spanned<String>| {
        let name = given.get_ref();
        let file = folder.join(name);
        let scene = match scenes::find(Path::new(name)) {
            _ if file.exists() => Source::read(&file)?,
            Some(bundled) => Source::new(folder.join(bundled.file()), bundled.text()),
            None => {
                let problem = format!(
                    "there is no scene {name:?}, allowed: a scene file, as seen from here, or one of {}",
                    scenes::names()
                );
                return Err(source.error_at(given.span().start, problem));
            }
        };
        Ok(BaseScene {
            name: name.clone(),
            table: scene.toml()?,
            source: scene,
        })
    };
    names.iter().map(scene).collect()
}

/// `[vary]`, in the order of the file.
fn axes(source: &Source, is_grid: bool) -> Result<Vec<Axis>, InputError> {
    // Invalid TOML was refused before.
    let document = DeTable::parse(source.text()).map_err(|error| source.error(error.message()))?;
    let mut given = Vec::new();
    if let Some(vary) = document.get_ref().get("vary") {
        leaves(source, "", vary, &mut given)?;
    }
    given.sort_by_key(|(offset, ..)| *offset);
    let mut axes: Vec<Axis> = Vec::with_capacity(given.len());
    for (offset, key, value) in given {
        let name = key.name().to_owned();
        let error = |problem: String| source.error_at(offset, format!("`{name}` {problem}"));
        if axes.iter().any(|axis| axis.key.name() == name) {
            return Err(error("is given twice, allowed: once".to_owned()));
        }
        axes.push(Axis::new(key, offset, value, is_grid).map_err(error)?);
    }
    Ok(axes)
}

/// Keys with their values below a table, written with quotes, as `"a.b" = ...`, or without.
fn leaves(
    source: &Source,
    path: &str,
    node: &Spanned<DeValue<'_>>,
    into: &mut Vec<(usize, Key, Value)>,
) -> Result<(), InputError> {
    let DeValue::Table(table) = node.get_ref() else {
        let problem = format!(
            "`vary{path}` is no key with values, allowed: {}",
            key::all()
        );
        return Err(source.error_at(node.span().start, problem));
    };
    for (name, node) in table {
        let offset = name.span().start;
        let path = format!("{path}.{}", name.get_ref());
        let is_section = matches!(node.get_ref(), DeValue::Table(below)
            if !below.contains_key("from") && !below.contains_key("to"));
        if is_section {
            leaves(source, &path, node, into)?;
            continue;
        }
        let key = Key::parse(&path[1..]).ok_or_else(|| {
            let problem = format!(
                "there is no `{}` to vary, allowed: {}",
                &path[1..],
                key::all()
            );
            source.error_at(offset, problem)
        })?;
        let value = Value::deserialize(ValueDeserializer::from(node.clone()))
            .map_err(|error| source.error_at(offset, error.message()))?;
        into.push((offset, key, value));
    }
    Ok(())
}
