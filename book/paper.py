"""What the paper's text says of its missing alpha and omega, and the likeliest pairs, as data. Nothing is computed.

The parameters that it does state are in `duffing.paper`, its claims in `book.claims.text`.

Source: M. Borowiec, G. Litak and A. Syta, "Vibration of the Duffing oscillator: effect of fractional damping",
arXiv:nlin/0601033; Shock and Vibration 14 (2007) 29-36.
"""

from typing import NamedTuple


class Statement(NamedTuple):
    """A sentence of the text that constrains alpha and omega: a key, where it stands, its words, what must hold."""

    key: str
    where: str
    quotation: str
    holds: str


STATEMENTS = (
    Statement(
        "lambda-027",
        "Section 2",
        "“The corresponding Lyapunow exponent λ₁=0.175 is positive”",
        "λ₁ = 0.175 at p = 0.1, μ = 0.27",
    ),
    Statement(
        "lambda-025",
        "Section 2",
        "“the corresponding Lyapunov exponent λ₁=−0.023 is negative”",
        "λ₁ = −0.023 at p = 0.1, μ = 0.25",
    ),
    Statement(
        "no-chaos-below",
        "Section 2, Fig. 4a",
        "“a minimal threshold of λ₁=0.1 above which the system was identified in a chaotic state (see Figs. 3b, 4a and 4b)”",
        "no λ₁ > 0.1 below μ = 0.25 at p = 0.1",
    ),
    Statement(
        "onset-027",
        "Section 2, Fig. 4a",
        "“that λ₁ which appears at μ ≈ 0.27” … “just after the system transition to a chaotic motion”",
        "λ₁ first exceeds 0.1 at μ ≈ 0.27 and not above it",
    ),
    Statement(
        "not-periodic",
        "Fig. 5a, 6a",
        "“It is easy to see that Fig. 5a represents a non-periodic vibration state (μ=0.27)”",
        "no period of six forcing periods or fewer on t ∈ [1200, 1500] at μ = 0.27",
    ),
    Statement(
        "transient",
        "Fig. 5b, 6b",
        "“after some time of chaotic transient motion with a large amplitude of oscillations and jumping between potential "
        "wells we got steady state regular vibrations … located in a single potential well”",
        "several changes of well before t = 1200 and none after it at μ = 0.25",
    ),
    Statement(
        "much-smaller",
        "Fig. 6b",
        "“steady state regular vibrations of much smaller amplitude”",
        "amplitude after t = 1200 much smaller than before at μ = 0.25",
    ),
    Statement(
        "weak-positive",
        "Section 2, Fig. 4a",
        "“for p=0.1 we have got some small but positive values of λ₁ for weak excitation (μ close to 0)”",
        "some 0 < λ₁ < 0.1 for μ ≤ 0.04 at p = 0.1",
    ),
    Statement(
        "above-line",
        "Fig. 3b",
        "“in all cases (Fig. 3b) points are above the line”",
        "onset of λ₁ > 0.1 above $μ_c$ at p = 0.1, 1 and 2",
    ),
    Statement(
        "agreement",
        "Fig. 3b",
        "“both sets of results: analytical and numerical are in good agreement”",
        "onset of λ₁ > 0.1 near $μ_c$ at p = 0.1, 1 and 2",
    ),
    Statement(
        "larger-lambda",
        "Section 3, Fig. 4",
        "“comparing Figs. 4a and b, we observe larger Lyapunov exponents for a fractional p (p=0.1 in Fig. 4a)”",
        "largest λ₁ for μ ≤ 0.4 at p = 0.1 above that at p = 1",
    ),
    Statement(
        "sign-change",
        "Section 2, Fig. 4",
        "“One can clearly see the point of λ₁ sign change. This indicates transition to chaotic vibrations.”",
        "chaos prevails above the onset at p = 0.1 and at p = 1",
    ),
)


class Pair(NamedTuple):
    """A candidate for the missing alpha and omega: its letter, its values, and how it was chosen."""

    letter: str
    alpha: float
    omega: float
    chosen: str


# The first is adopted throughout the book; `tests/test_missing_parameters.py` finds all of them again.
LIKELY = (
    Pair("A", 0.1, 1.0, "adopted: the likeliest pair with alpha a multiple of 0.01 and omega a multiple of 0.1"),
    Pair("B", 0.15, 1.1875, "the likeliest pair of the plane in steps of 0.005 and 0.0125"),
    Pair("C", 0.095, 1.2625, "the next likeliest pair of that plane that is no neighbour of B"),
)
