"""Eight doubles as one number: what compiled code computes for eight lanes at once.

Numba has no type for a vector. Left to find vectors in loops over lanes, LLVM takes long to compile, and what it finds
hangs on details of how the loop is written. So vectors are spelled out: a `Vector` is added, compared and chosen from
as a float is, lane by lane, in the operations that IEEE 754 fixes; the processor takes as many instructions as its
registers ask for. A function of such operations serves a single double as well as eight.
"""

import operator

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.datamodel import PrimitiveModel, register_default
from numba.core.imputils import lower_builtin, lower_cast
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

EIGHT = 8


class Vector(types.Type):
    """Numba's type of eight numbers of an LLVM type: doubles, their bits, or truth values."""

    def __init__(self, name, element):
        super().__init__(f"eight {name}")
        self.llvm = ir.VectorType(element, EIGHT)


@register_default(Vector)
class _Model(PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, kind.llvm)


DOUBLES = Vector("doubles", ir.DoubleType())
WORDS = Vector("words", ir.IntType(64))
TRUTHS = Vector("truths", ir.IntType(1))
_OF = {types.float64: DOUBLES, types.uint64: WORDS, types.boolean: TRUTHS}  # what a single one is repeated to


# Asked before what Numba has for any target, which takes long to say that it has none.
FIRST = {"target": "cpu"}


class _First(ConcreteTemplate):
    metadata = FIRST


def _repeated(builder, value, kind):
    """A value of this type as eight lanes: itself, or a scalar in each."""
    if isinstance(kind, Vector):
        return value
    if isinstance(value, ir.Constant):
        return ir.Constant(ir.VectorType(value.type, EIGHT), [value] * EIGHT)
    if value.type != _OF[kind].llvm.element:  # a truth value is kept as a byte, and is one bit here
        value = builder.trunc(value, _OF[kind].llvm.element)
    one = builder.insert_element(ir.Constant(_OF[kind].llvm, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), EIGHT), [0] * EIGHT)
    return builder.shuffle_vector(one, ir.Constant(_OF[kind].llvm, ir.Undefined), zeros)


def _define(function, result, scalar, vector, build):
    """The builtin or operator `function` of two vectors or of a vector and a scalar, built by LLVM's instruction."""
    operands = [(vector, vector), (vector, scalar), (scalar, vector)]

    @infer_global(function)
    class Template(_First):
        cases = tuple(signature(result, *case) for case in operands)

    for case in operands:

        @lower_builtin(function, *case)
        def lower(context, builder, sig, arguments):
            return build(builder, *(_repeated(builder, a, k) for a, k in zip(arguments, sig.args, strict=True)))


def _compare(predicate, ordered=True):
    def build(builder, a, b):
        return (builder.fcmp_ordered if ordered else builder.fcmp_unordered)(predicate, a, b)

    return build


def _greater(builder, a, b):
    return builder.select(builder.fcmp_ordered(">", b, a), b, a)  # as Python chooses if one is no number


for _function, _build in (
    (operator.add, lambda builder, a, b: builder.fadd(a, b)),
    (operator.sub, lambda builder, a, b: builder.fsub(a, b)),
    (operator.mul, lambda builder, a, b: builder.fmul(a, b)),
    (operator.truediv, lambda builder, a, b: builder.fdiv(a, b)),
    (max, _greater),
):
    _define(_function, DOUBLES, types.float64, DOUBLES, _build)
for _function, _sign in ((operator.lt, "<"), (operator.le, "<="), (operator.gt, ">"), (operator.ge, ">=")):
    _define(_function, TRUTHS, types.float64, DOUBLES, _compare(_sign))
_define(operator.eq, TRUTHS, types.float64, DOUBLES, _compare("=="))
_define(operator.ne, TRUTHS, types.float64, DOUBLES, _compare("!=", ordered=False))
_define(operator.and_, TRUTHS, types.boolean, TRUTHS, lambda builder, a, b: builder.and_(a, b))
_define(operator.or_, TRUTHS, types.boolean, TRUTHS, lambda builder, a, b: builder.or_(a, b))
for _function, _build in (
    (operator.add, lambda builder, a, b: builder.add(a, b)),
    (operator.and_, lambda builder, a, b: builder.and_(a, b)),
    (operator.or_, lambda builder, a, b: builder.or_(a, b)),
    (operator.lshift, lambda builder, a, b: builder.shl(a, b)),
    (operator.rshift, lambda builder, a, b: builder.lshr(a, b)),
):
    _define(_function, WORDS, types.uint64, WORDS, _build)


@infer_global(operator.neg)
class _Negative(_First):
    cases = (signature(DOUBLES, DOUBLES),)


@infer_global(abs)
class _Absolute(_First):
    cases = (signature(DOUBLES, DOUBLES),)


@lower_builtin(operator.neg, DOUBLES)
def _negative(context, builder, sig, arguments):
    return builder.fneg(*arguments)


@lower_builtin(abs, DOUBLES)
def _absolute(context, builder, sig, arguments):
    return _llvm(builder, "llvm.fabs", DOUBLES.llvm, arguments)


@lower_cast(types.float64, DOUBLES)
def _cast(context, builder, of, to, value):
    return _repeated(builder, value, of)


def _llvm(builder, name, kind, arguments):
    """Call one of LLVM's own functions, of doubles or of vectors of them."""
    suffix = "v8f64" if isinstance(kind, ir.VectorType) else "f64"
    function = ir.FunctionType(kind, [kind] * len(arguments))
    return builder.call(cgutils.get_or_insert_function(builder.module, function, f"{name}.{suffix}"), arguments)


def _common(*kinds):
    """Doubles, if one of the types is; else the type of a single double."""
    return DOUBLES if DOUBLES in kinds else types.float64


@intrinsic
def fma(typingctx, a, b, c):
    """a b + c with one rounding (compiled code only), of doubles or of vectors of them.

    Spelled out, because what a compiler fuses by itself differs from machine to machine, and chaos shows it. A
    processor without the instruction (x86 before 2013) gets the same bits from a library, slowly.
    """
    result = _common(a, b, c)

    def codegen(context, builder, sig, arguments):
        if result is DOUBLES:
            arguments = [_repeated(builder, x, kind) for x, kind in zip(arguments, sig.args, strict=True)]
        return _llvm(builder, "llvm.fma", context.get_value_type(result), arguments)

    return result(*(kind if kind is DOUBLES else types.float64 for kind in (a, b, c))), codegen


@intrinsic
def root(typingctx, a):
    """Square root of a double or of eight; no number below zero."""

    def codegen(context, builder, sig, arguments):
        return _llvm(builder, "llvm.sqrt", context.get_value_type(a), arguments)

    return a(a), codegen


@intrinsic
def where(typingctx, condition, a, b):
    """a where the condition holds, else b: a selection, no branch; for one lane or for eight."""
    result = _common(a, b) if condition is not TRUTHS else DOUBLES

    def codegen(context, builder, sig, arguments):
        test, *values = arguments
        if result is DOUBLES:
            values = [_repeated(builder, x, kind) for x, kind in zip(values, sig.args[1:], strict=True)]
        return builder.select(test, *values)

    return result(condition, *(kind if kind is DOUBLES else types.float64 for kind in (a, b))), codegen


def _same_bits(context, builder, sig, arguments):
    return builder.bitcast(arguments[0], context.get_value_type(sig.return_type))


@intrinsic
def bits(typingctx, a):
    """The bits of a double, or of eight, as whole numbers."""
    return (WORDS if a is DOUBLES else types.uint64)(a), _same_bits


@intrinsic
def from_bits(typingctx, a):
    """The double, or the eight, with these bits."""
    return (DOUBLES if a is WORDS else types.float64)(a), _same_bits


@intrinsic
def repeated(typingctx, value, like):
    """A scalar in each of eight lanes, or as it is where `like` is a scalar."""

    def codegen(context, builder, sig, arguments):
        return _repeated(builder, arguments[0], types.float64) if like is DOUBLES else arguments[0]

    return like(types.float64, like), codegen


@intrinsic
def take(typingctx, table, index):
    """table[index], of one lane or of eight: index, whole numbers without a sign, must be in the table."""
    result = DOUBLES if index is WORDS else types.float64

    def codegen(context, builder, sig, arguments):
        data = make_array(table)(context, builder, arguments[0]).data
        at = builder.gep(data, [arguments[1]], source_etype=ir.DoubleType())
        if result is not DOUBLES:
            return builder.load(at, typ=ir.DoubleType())
        at.type = ir.VectorType(ir.PointerType(), EIGHT)  # llvmlite takes it for one address
        mask, align = ir.VectorType(ir.IntType(1), EIGHT), ir.IntType(32)
        kinds = [at.type, align, mask, DOUBLES.llvm]
        gather = cgutils.get_or_insert_function(
            builder.module, ir.FunctionType(DOUBLES.llvm, kinds), "llvm.masked.gather.v8f64.v8p0"
        )
        everywhere = ir.Constant(mask, [ir.Constant(ir.IntType(1), 1)] * EIGHT)
        return builder.call(gather, [at, align(8), everywhere, ir.Constant(DOUBLES.llvm, ir.Undefined)])

    return result(table, index), codegen
