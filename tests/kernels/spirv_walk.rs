//! Which of a kernel's code can be reached once its specialization constants are known.

use std::collections::{BTreeSet, HashMap, HashSet};

use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{Decoration, Op, Word};
use zerkalo::gpu::Shader;

pub struct Kernel {
    module: Module,
    names: HashMap<Word, String>,
}

/// What of a kernel its constants leave.
pub struct Reached {
    /// Of functions, with a bracket after their GLSL name, and of global variables.
    pub names: BTreeSet<String>,
    pub instructions: usize,
    /// Reads of texel buffers in the code.
    pub fetches: usize,
    /// Jumps back to a loop's head.
    pub back_edges: usize,
}

/// Known integers and truth values.
type Values = HashMap<Word, u32>;

impl Kernel {
    pub fn of(shader: &Shader) -> Self {
        let words: Vec<u32> =
            shader.spirv().chunks_exact(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap())).collect();
        let module = rspirv::dr::load_words(words).unwrap();
        let named = module.debug_names.iter().filter(|name| name.class.opcode == Op::Name);
        let names = named.map(|name| (name.operands[0].unwrap_id_ref(), name.operands[1].unwrap_literal_string()));
        let names = names.map(|(id, name)| (id, name.to_owned())).collect();
        Self { module, names }
    }

    /// With the constants by their `constant_id`.
    pub fn reached(&self, constants: &[u32]) -> Reached {
        let values = self.constants(constants);
        let entry = self.module.entry_points[0].operands[1].unwrap_id_ref();
        let mut reached = Reached { names: BTreeSet::new(), instructions: 0, fetches: 0, back_edges: 0 };
        let (mut due, mut seen) = (vec![entry], HashSet::from([entry]));
        while let Some(id) = due.pop() {
            let function = self.module.functions.iter().find(|function| function.def_id() == Some(id)).unwrap();
            for instruction in self.walk(function, &values, &mut reached) {
                for id in instruction.operands.iter().filter_map(id_of) {
                    let is_called = instruction.class.opcode == Op::FunctionCall;
                    let is_global = self
                        .module
                        .types_global_values
                        .iter()
                        .any(|global| global.class.opcode == Op::Variable && global.result_id == Some(id));
                    if is_global || is_called && self.is_function(id) {
                        reached.names.extend(self.names.get(&id).cloned());
                    }
                    if is_called && self.is_function(id) && seen.insert(id) {
                        due.push(id);
                    }
                }
            }
        }
        reached
    }

    fn is_function(&self, id: Word) -> bool {
        self.module.functions.iter().any(|function| function.def_id() == Some(id))
    }

    fn constants(&self, constants: &[u32]) -> Values {
        let spec_ids: HashMap<Word, usize> = (self.module.annotations.iter())
            .filter(|decoration| {
                decoration.class.opcode == Op::Decorate
                    && decoration.operands[1] == Operand::Decoration(Decoration::SpecId)
            })
            .map(|decoration| {
                (decoration.operands[0].unwrap_id_ref(), decoration.operands[2].unwrap_literal_bit32() as usize)
            })
            .collect();
        let mut values = Values::new();
        for global in &self.module.types_global_values {
            let Some(id) = global.result_id else { continue };
            let own = match (global.class.opcode, global.operands.first()) {
                (Op::ConstantTrue, _) => Some(1),
                (Op::ConstantFalse, _) => Some(0),
                (Op::Constant, Some(&Operand::LiteralBit32(number))) => Some(number),
                (Op::SpecConstant | Op::SpecConstantTrue | Op::SpecConstantFalse, _) => Some(constants[spec_ids[&id]]),
                (Op::SpecConstantOp, Some(&Operand::LiteralSpecConstantOpInteger(op))) => {
                    folded(op, &global.operands[1..], &values)
                }
                _ => None,
            };
            values.extend(own.map(|value| (id, value)));
        }
        values
    }

    /// The instructions of a function that are left; counts them.
    fn walk<'a>(&self, function: &'a Function, constants: &Values, reached: &mut Reached) -> Vec<&'a Instruction> {
        let mut values = constants.clone();
        let labels: Vec<Word> = function.blocks.iter().map(|block| block.label_id().unwrap()).collect();
        let mut ways: HashSet<(Word, Word)> = HashSet::new();
        let mut left = Vec::new();
        // Blocks come after those that lead to them, but for jumps back, whose heads are reached from before.
        for (place, block) in function.blocks.iter().enumerate() {
            if place > 0 && !ways.iter().any(|(_, to)| *to == labels[place]) {
                continue;
            }
            for instruction in &block.instructions {
                let opcode = instruction.class.opcode;
                let known = match opcode {
                    Op::Phi => phi(instruction, labels[place], &ways, &values),
                    _ => folded(opcode, &instruction.operands, &values),
                };
                values.extend(instruction.result_id.zip(known));
                reached.fetches += usize::from(opcode == Op::ImageFetch);
            }
            let last = block.instructions.last().unwrap();
            let targets: Vec<Word> = match last.class.opcode {
                Op::Branch => vec![last.operands[0].unwrap_id_ref()],
                Op::BranchConditional => {
                    let sides = [1, 2].map(|side| last.operands[side].unwrap_id_ref());
                    match values.get(&last.operands[0].unwrap_id_ref()) {
                        Some(0) => vec![sides[1]],
                        Some(_) => vec![sides[0]],
                        None => sides.to_vec(),
                    }
                }
                Op::Return | Op::ReturnValue | Op::Unreachable => Vec::new(),
                other => panic!("{other:?} ends a block"),
            };
            reached.back_edges += targets.iter().filter(|target| labels[..=place].contains(target)).count();
            ways.extend(targets.into_iter().map(|target| (labels[place], target)));
            left.extend(&block.instructions);
        }
        reached.instructions += left.len();
        left
    }
}

/// Where all ways that are left bring the same.
fn phi(instruction: &Instruction, label: Word, ways: &HashSet<(Word, Word)>, values: &Values) -> Option<u32> {
    let incoming = instruction.operands.chunks(2).map(|pair| (pair[0].unwrap_id_ref(), pair[1].unwrap_id_ref()));
    let open: Vec<Option<u32>> =
        incoming.filter(|(_, from)| ways.contains(&(*from, label))).map(|(id, _)| values.get(&id).copied()).collect();
    open.iter().all(|value| *value == open[0]).then(|| open[0]).flatten()
}

fn id_of(operand: &Operand) -> Option<Word> {
    if let Operand::IdRef(id) = operand { Some(*id) } else { None }
}

fn folded(op: Op, operands: &[Operand], values: &Values) -> Option<u32> {
    let known = |place: usize| operands.get(place).and_then(id_of).and_then(|id| values.get(&id)).copied();
    let both = || Some((known(0)?, known(1)?));
    match op {
        Op::LogicalNot => known(0).map(|value| 1 - value),
        Op::LogicalAnd if known(0) == Some(0) || known(1) == Some(0) => Some(0),
        Op::LogicalOr if known(0) == Some(1) || known(1) == Some(1) => Some(1),
        Op::LogicalAnd => both().map(|(a, b)| a & b),
        Op::LogicalOr => both().map(|(a, b)| a | b),
        Op::Select => {
            if known(0)? == 1 {
                known(1)
            } else {
                known(2)
            }
        }
        Op::IAdd => both().map(|(a, b)| a.wrapping_add(b)),
        Op::ISub => both().map(|(a, b)| a.wrapping_sub(b)),
        Op::IMul => both().map(|(a, b)| a.wrapping_mul(b)),
        Op::IEqual => both().map(|(a, b)| u32::from(a == b)),
        Op::INotEqual => both().map(|(a, b)| u32::from(a != b)),
        Op::UGreaterThan => both().map(|(a, b)| u32::from(a > b)),
        Op::ULessThan => both().map(|(a, b)| u32::from(a < b)),
        Op::ULessThanEqual => both().map(|(a, b)| u32::from(a <= b)),
        _ => None,
    }
}
