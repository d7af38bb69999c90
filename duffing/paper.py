"""The paper's parameter sets, figure by figure, as data. Nothing is computed.

Source: M. Borowiec, G. Litak and A. Syta, "Vibration of the Duffing oscillator: effect of fractional damping",
arXiv:nlin/0601033; Shock and Vibration 14 (2007) 29-36.
"""

from .oscillator import Duffing

# alpha and omega are missing in the paper: this pair is adopted, not recovered.
OSCILLATOR = Duffing(alpha=0.1, p=0.1, mu=0.0, omega=1.0, delta=-1.0, gamma=1.0)
START = (0.45, 0.1)  # "the same initial conditions (x0, v0) for every new value of mu"
STEPS_PER_PERIOD = 500  # "in most cases we used dt = 2 pi / (500 omega)"
THRESHOLD = 0.1  # "a minimal threshold of lambda_1 = 0.1"
SETTLED, END = 1200.0, 1500.0  # the times of Fig. 5 and 6, "in arbitrary units of 1/omega"
PERIODS = 239  # forcing periods: omega END / (2 pi), rounded
P_ONSET = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0)  # the circles of Fig. 3b
P_SMALL, P_LINEAR = 0.1, 1.0  # Fig. 4a and 4b; Fig. 5 and 6 are at P_SMALL
MU_CHAOTIC, MU_REGULAR = 0.27, 0.25  # Fig. 5a, 6a and Fig. 5b, 6b
LAMBDA_CHAOTIC, LAMBDA_REGULAR = 0.175, -0.023  # the exponents quoted for them
