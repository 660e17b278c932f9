"""Judging pictures: a bias verdict with known false alarms, and a perceptual score.

`bias` says whether an estimator converges to the reference; `perceptual` says how visible its error
is; `image` puts both together for one scene of one module; `compare` answers for any two pictures.
"""
