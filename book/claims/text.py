"""What the paper claims, statement by statement, as data; the findings on them are in the other modules of this room.

Source: M. Borowiec, G. Litak and A. Syta, "Vibration of the Duffing oscillator: effect of fractional damping",
arXiv:nlin/0601033; Shock and Vibration 14 (2007) 29-36.
"""

from typing import NamedTuple


class Claim(NamedTuple):
    """One statement of the paper: a key, the place where it stands, and what it says (short quotations in “ ”)."""

    key: str
    where: str
    says: str


CLAIMS = (
    Claim("eq-1-5", "Eq. 1, 3, 5", "The equation of motion and the first-order system of Eq. 5 are the same."),
    Claim("eq-2", "Eq. 2", "The force −δx − γx³ derives from V(x) = δx²/2 + γx⁴/4."),
    Claim("dry-friction", "Section 1, Fig. 1b", "The case p → 0 “mimics the dry friction phenomenon”."),
    Claim("saddle", "Section 2, Fig. 1a", "V(x) has “the local peak at the saddle point x = 0”."),
    Claim("eq-4-7", "Eq. 4, 6, 7", "Zero energy gives the velocity of Eq. 6 and the integral of Eq. 7."),
    Claim("eq-8", "Eq. 8", "The homoclinic orbits x* and v*."),
    Claim("eq-8-sides", "below Eq. 8", "“'+' and '−' signs are related to left- and right-side orbits, respectively”."),
    Claim("eq-8-limits", "below Eq. 8", "The saddle point is reached for t → ±∞."),
    Claim(
        "fig-2",
        "Fig. 2",
        "Perturbed, the homoclinic orbit splits into $W^S$ and $W^U$, which cross for strong enough forcing.",
    ),
    Claim("eq-9", "Eq. 9", "The distance between $W^S$ and $W^U$ “is given by the Melnikov function”."),
    Claim("eq-10-11", "Eq. 10, 11", "h is the gradient of the Hamiltonian, g the perturbation, both as forms."),
    Claim("eq-12", "Eq. 12", "A simple zero of M(t₀) is the condition for a global homoclinic transition."),
    Claim("eq-13", "Eq. 13", "The critical amplitude $μ_c$ in closed form."),
    Claim("eq-14-15", "Eq. 14, 15", "Euler's Beta function by Gamma functions, and Γ(n + 1) = nΓ(n)."),
    Claim("sufficient", "Abstract", "$μ_c$ “is the sufficient condition of a global homoclinic bifurcation”."),
    Claim("necessary", "Sections 2, 3", "λ₁ > 0 is a sufficient criterion of chaos, Melnikov's only a necessary one."),
    Claim("monotone", "Fig. 3, conclusions", "By Melnikov's estimate the cases p < 1 are more stable than p = 1."),
    Claim("can-transit", "Section 2", "“For μ > $μ_c$ the system can transit to chaotic vibrations.”"),
    Claim("above-line", "Fig. 3b", "“in all cases … points are above the line”."),
    Claim("agreement", "Fig. 3b", "Analytical and numerical results “are in good agreement”."),
    Claim(
        "sign-change", "Fig. 4", "One sees the sign change of λ₁, which “indicates transition to chaotic vibrations”."
    ),
    Claim("false-positive", "Fig. 4a", "At p = 0.1 there are “small but positive values of λ₁ for weak excitation”."),
    Claim("small-amplitude", "Section 2", "For μ close to 0 at p = 0.1 the “amplitude of vibrations was very small”."),
    Claim(
        "smaller-steps",
        "Section 2",
        "Steps 50 times smaller are “sufficient to reduce the positive value around μ = 0”.",
    ),
    Claim("robust-onset", "Section 2", "… “leaving, in principle, unchanged that λ₁ which appears at μ ≈ 0.27”."),
    Claim("threshold", "Section 2, Fig. 4", "Above the threshold λ₁ = 0.1 the system is in a chaotic state."),
    Claim("lambda-027", "Section 2, Fig. 4a", "λ₁ = 0.175 at p = 0.1, μ = 0.27."),
    Claim("lambda-025", "Section 2, Fig. 4a", "λ₁ = −0.023 at p = 0.1, μ = 0.25: “a convergent motion”."),
    Claim("just-after", "Fig. 4a, 5a", "μ = 0.27 lies “just after the system transition to a chaotic motion”."),
    Claim("fig-5a", "Fig. 5a, 6a", "At μ = 0.27 the vibration on t ∈ [1200, 1500] is non-periodic and chaotic."),
    Claim("fig-5b-transient", "Fig. 5b, 6b", "At μ = 0.25 a large transient jumps between the wells."),
    Claim("fig-5b-steady", "Fig. 5b, 6b", "At μ = 0.25 the steady state is small, regular and in a single well."),
    Claim("t-1200", "Section 2", "t = 1200 was “chosen in such a way to reach by our system a steady state”."),
    Claim("mu-c2", "Conclusions", "The Lyapunov threshold lies higher than Melnikov's: $μ_{c2} > μ_{c1}$."),
    Claim("transients", "Conclusions", "Above the Melnikov prediction there are “transient chaotic vibrations”."),
    Claim(
        "resonance",
        "Conclusions",
        "Near resonance the “amplitude response rised for small fractional exponents (p < 1)”.",
    ),
    Claim("larger-lambda", "Conclusions", "λ₁ is larger at p = 0.1 than at p = 1 (Fig. 4a and b)."),
    Claim("contradiction", "Conclusions", "Larger λ₁ at small p contradicts the ordering of Melnikov's thresholds."),
    Claim("algorithm", "Conclusions", "For small p “one must improve a simple numerical algorithm”."),
    Claim("dampers", "Conclusions", "The approach can be used for magnetorheological dampers in vehicle dynamics."),
)
