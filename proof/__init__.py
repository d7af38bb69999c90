"""Theorems about the homoclinic tangency, proved in ball arithmetic. Read in this order, beside chapters/proof.md:

    oscillator    the equation in exact numbers; Taylor coefficients
    lohner        a set of solutions over a time step, with derivatives; for p = 2 also where v changes its sign
    crossing      a set to its first crossing of v = 0
    saddle        the saddle orbit (Krawczyk)
    manifold      its unstable manifold: cones near it, a piece flown to v = 0
    rational      intervals with rational ends
    pieces        a manifold in pieces; two pieces are apart
    cover         no primary intersection at one forcing amplitude (or an interval of them)
    theorems      below, above and between
    first         no primary intersection for any smaller forcing amplitude
    check         the checker of a certificate

`python -m proof` finds every proof anew; nothing else in this repository imports this folder but a chapter and a test.
"""
