"""Memory of the lanes: on the stack, where LLVM sees that no other pointer leads, with views of it by rows.

Quantity Q of lane l is lanes(block, part)[Q, l]; that of the lanes 8 c to 8 c + 7, as one vector, is
eights(block, part)[Q, c].
"""

import math

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.arrayobj import make_array, populate_array

from .vectors import DOUBLES, EIGHT


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


def views(parts, width):
    """(lanes, eights): functions of (block, part) that return views of one part of a block, by lanes or by eights.

    parts : for each part the shape of its rows, (rows,) or (stages, rows); each row has `width` lanes. The parts follow
        one another in the block.
    """

    def view(dtype, number):
        @intrinsic(prefer_literal=True)
        def of_part(typingctx, block, part):
            shape = (*parts[part.literal_value], width // number)
            first = width * sum(math.prod(rows) for rows in parts[: part.literal_value])
            kind = types.Array(dtype, len(shape), "C")

            def codegen(context, builder, signature, arguments):
                array = make_array(kind)(context, builder)
                start = builder.gep(arguments[0], [context.get_constant(types.intp, first)])
                size = 8 * number

                def constants(values):
                    return [context.get_constant(types.intp, value) for value in values]

                strides = [size * math.prod(shape[axis + 1 :]) for axis in range(len(shape))]
                data = builder.bitcast(start, array.data.type)
                populate_array(array, data, constants(shape), constants(strides), constants([size])[0], None)
                return array._getvalue()

            return kind(block, part), codegen

        return of_part

    return view(types.float64, 1), view(DOUBLES, EIGHT)
