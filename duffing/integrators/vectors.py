"""What LLVM must be told for loops over lanes to use the vector units: where memory is, how wide vectors may be."""

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic


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
    nowhere does it change a result. Loops of an inlined function are vectorised before they come to their caller: the
    call belongs where the loop is.
    """

    def codegen(context, builder, signature, arguments):
        # llvmlite's own `add` knows the attributes without a value only.
        set.add(builder.function.attributes, '"prefer-vector-width"="512"')
        return context.get_dummy_value()

    return types.void(), codegen
