"""Memory of the lanes: on the stack, where LLVM sees that no other pointer leads, with views of it by rows.

Quantity Q of lane l is lanes(block, part)[Q, l]; that of the lanes 8 c to 8 c + 7, as one vector, is
eights(block, part)[Q, c].
"""

import math
import operator

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.datamodel import PrimitiveModel, register_default
from numba.core.imputils import lower_builtin
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic

from .vectors import DOUBLES, EIGHT, FIRST


@intrinsic(prefer_literal=True)
def stack(typingctx, size):
    """Memory for `size` (a constant) doubles, zeros, on the stack: LLVM sees that no other pointer leads there."""

    def codegen(context, builder, signature, arguments):
        array = ir.ArrayType(ir.DoubleType(), size.literal_value)
        memory = cgutils.alloca_once(builder, array, zfill=True)
        memory.align = 64  # whole cache lines
        return builder.bitcast(memory, context.get_value_type(signature.return_type))

    return types.CPointer(types.float64)(size), codegen


@intrinsic
def widest_vectors(typingctx):
    """Let the function that calls this have all of a vector register, 512 bits where the processor has them.

    LLVM takes 256 on many such processors, since early ones slowed down under more. Elsewhere it changes nothing, and
    nowhere does it change a result. The call belongs into each function that is compiled by itself.
    """

    def codegen(context, builder, signature, arguments):
        # llvmlite's own `add` knows the attributes without a value only.
        set.add(builder.function.attributes, '"prefer-vector-width"="512"')
        return context.get_dummy_value()

    return types.void(), codegen


class View(types.Type):
    """Numba's type of an array of a shape known when compiling, in memory that begins at a pointer.

    Its indices are not checked, and none counts from the end: what an array of Numba's does for that is most of the
    code that LLVM would have to take away again.
    """

    def __init__(self, dtype, shape):
        super().__init__(f"view of {dtype}, {shape}")
        self.dtype, self.shape = dtype, shape


@register_default(View)
class _Model(PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, ir.DoubleType().as_pointer())


def _number(index):
    return len(index) if isinstance(index, types.BaseTuple) else 1


@infer_global(operator.getitem)
class _Get(AbstractTemplate):
    metadata = FIRST

    def generic(self, args, kws):
        view, index = args
        if isinstance(view, View):
            left = view.shape[_number(index) :]
            return signature(View(view.dtype, left) if left else view.dtype, view, index)


@infer_global(operator.setitem)
class _Set(AbstractTemplate):
    metadata = FIRST

    def generic(self, args, kws):
        view, index, _ = args
        if isinstance(view, View) and _number(index) == len(view.shape):
            return signature(types.none, view, index, view.dtype)


def _address(context, builder, sig, arguments):
    """Pointer to the element, or to the first one, that the index leads to."""
    view, index = sig.args[:2]
    several = isinstance(index, types.BaseTuple)
    kinds = index.types if several else [index]
    values = cgutils.unpack_tuple(builder, arguments[1]) if several else [arguments[1]]
    size, offset, known = EIGHT if view.dtype is DOUBLES else 1, [], 0
    for axis, (kind, value) in enumerate(zip(kinds, values, strict=True)):
        stride = size * math.prod(view.shape[axis + 1 :])
        if isinstance(kind, types.Literal):
            known += stride * kind.literal_value
        else:
            offset.append(builder.mul(value, context.get_constant(types.intp, stride)))
    place = context.get_constant(types.intp, known)
    for each in offset:
        place = builder.add(place, each)
    return builder.gep(arguments[0], [place], inbounds=True, source_etype=ir.DoubleType())


def _element(context, builder, sig, arguments):
    pointer = context.get_value_type(sig.args[0].dtype).as_pointer()
    return builder.bitcast(_address(context, builder, sig, arguments), pointer)


@lower_builtin(operator.getitem, View, types.BaseTuple)
@lower_builtin(operator.getitem, View, types.Integer)
def _get(context, builder, sig, arguments):
    if isinstance(sig.return_type, View):
        return _address(context, builder, sig, arguments)
    return builder.load(_element(context, builder, sig, arguments))


@lower_builtin(operator.setitem, View, types.BaseTuple, types.Any)
@lower_builtin(operator.setitem, View, types.Integer, types.Any)
def _set(context, builder, sig, arguments):
    builder.store(arguments[2], _element(context, builder, sig, arguments))


def views(parts, width):
    """(lanes, eights): functions of (block, part) that return views of one part of a block, by lanes or by eights.

    parts : for each part the shape of its rows, (rows,) or (stages, rows); each row has `width` lanes. The parts follow
        one another in the block.
    """

    def view(dtype, number):
        @intrinsic(prefer_literal=True)
        def of_part(typingctx, block, part):
            first = width * sum(math.prod(rows) for rows in parts[: part.literal_value])

            def codegen(context, builder, signature, arguments):
                place = context.get_constant(types.intp, first)
                return builder.gep(arguments[0], [place], inbounds=True, source_etype=ir.DoubleType())

            return View(dtype, (*parts[part.literal_value], width // number))(block, part), codegen

        return of_part

    return view(types.float64, 1), view(DOUBLES, EIGHT)


@intrinsic(prefer_literal=True)
def matrix(typingctx, block, rows, columns):
    """View of doubles from a pointer on, with constant numbers of rows and columns."""

    def codegen(context, builder, signature, arguments):
        return arguments[0]

    return View(types.float64, (rows.literal_value, columns.literal_value))(block, rows, columns), codegen


@intrinsic
def apart(typingctx):
    """Keep the function that calls this out of its callers, and short: it is called seldom, and compiled once."""

    def codegen(context, builder, signature, arguments):
        for attribute in ("noinline", "optsize"):
            builder.function.attributes.add(attribute)
        return context.get_dummy_value()

    return types.void(), codegen
