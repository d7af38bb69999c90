"""How each claim of the paper stands to the missing alpha and omega: used to choose them, dependent on them, or neither.

A claim that was used to choose alpha and omega is confirmed in a circle; one that depends on them holds for the adopted
pair. Both are said in the ledger beside the verdict.
"""

# Claims that were used, and the statements of `book.paper.STATEMENTS` by which.
USED = {
    "above-line": ("above-line",),
    "agreement": ("agreement",),
    "sign-change": ("sign-change",),
    "false-positive": ("weak-positive",),
    "lambda-027": ("lambda-027",),
    "lambda-025": ("lambda-025",),
    "just-after": ("onset-027", "no-chaos-below"),
    "fig-5a": ("not-periodic",),
    "fig-5b-transient": ("transient",),
    "fig-5b-steady": ("transient", "much-smaller"),
    "t-1200": ("transient",),
    "mu-c2": ("above-line",),
    "larger-lambda": ("larger-lambda",),
}
# Claims whose verdict no choice of alpha > 0 and omega > 0 could change.
INDEPENDENT = frozenset(
    [
        "eq-1-5",
        "eq-2",
        "dry-friction",
        "saddle",
        "eq-4-7",
        "eq-8",
        "eq-8-sides",
        "eq-8-limits",
        "eq-10-11",
        "eq-12",
        "eq-13",
        "eq-14-15",
        "monotone",
        "dampers",
    ]
)
# What the paper saw in its figures and runs; all else are equations, and conclusions that it draws.
OBSERVED = frozenset(
    [
        "fig-2",
        "above-line",
        "sign-change",
        "false-positive",
        "small-amplitude",
        "smaller-steps",
        "robust-onset",
        "lambda-027",
        "lambda-025",
        "just-after",
        "fig-5a",
        "fig-5b-transient",
        "fig-5b-steady",
        "mu-c2",
        "transients",
        "resonance",
        "larger-lambda",
    ]
)


def kind(key):
    """ "equation", "observation" or "inference": what sort of statement the claim with this key is."""
    if key in OBSERVED:
        return "observation"
    return "equation" if key.startswith("eq-") or key == "saddle" else "inference"
