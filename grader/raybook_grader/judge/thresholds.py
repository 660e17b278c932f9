"""Every number that decides a verdict, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Thresholds:
    """Limits of the bias tests. A failure needs both significance and size.

    False alarms: at `alpha` each, the tests G, R, L16 and L32 together fail a right estimator in
    fewer than 4e-4 of first looks; a failure counts only when it repeats on fresh seeds, so in
    fewer than 4e-8 of verdicts (D adds at most 1e-7, see `dead_deviations`).
    """

    # Significance of one test. A class of 200 with 30 images each takes 6000 first looks: about two
    # right students are looked at twice, none fails.
    alpha: float = 1e-4
    # G: two different but right ways to integrate (a table's interpolation, an offset at a surface)
    # move the mean by up to 0.1 %; a mistake worth telling moves it by 1 %.
    global_bias: float = 0.0025
    # R: half of a 1 % brighter light; right variants measured below 0.2 %.
    rms_bias: float = 0.005
    # L: what 256 samples can tell of one tile; 1 % is also about what an eye can see at an edge.
    tile_bias: float = 0.01
    # A tile's error is relative to its luminance plus this part of the picture's: next to black,
    # a ratio means nothing.
    dark_floor: float = 0.05
    # R: one tile counts at most this much (a deviation of 7.7 sigma), so that the test is about
    # many tiles and L about one.
    deviation_cap: float = 60.0
    # D: a pixel is dead when it is this many standard deviations too dark, in both looks at the
    # same place. The noise used is never below the reference's own. Measured: an estimator at the
    # noise gate has one in 2 % of first looks, hence at the same place in 1e-7 of verdicts.
    dead_deviations: float = 6.0
    # D: and has less than this part of the reference's luminance, whatever the noise.
    dead_fraction: float = 0.5
    # D: one is enough: a hole in a mesh is one.
    dead_pixels: int = 1
    # Above this many times the reference's variance a sample, local tests lose their meaning:
    # 8 is sqrt(8) = 2.8 times the noise. Uniform instead of cosine-weighted directions cost 2.
    noise_ratio: float = 8.0
    # A sample's relative variance below this never makes a picture "too noisy": 256 samples leave
    # 0.6 % of noise in a pixel.
    harmless_variance: float = 0.01
    # Below this relative variance the reference is taken to be free of noise, and the pictures of
    # two seeds may be the same.
    random_variance: float = 1e-6
    # One pair only. A move of the picture by a tenth of a pixel, when it explains at least this
    # part of the difference; a wrong brightness next to edges explains up to 0.02.
    shift: float = 0.1
    shift_explains: float = 0.03
    # One pair only. FLIP beyond the noise's: a right picture's luck, plus what the noise model,
    # which sees one pair, gets wrong: it misses up to half of what jittered edges do, and the more
    # of heavy tails the noisier the pair (0.25 of the noise's FLIP at 0.35, 0.44 at 0.47).
    excess: float = 0.003
    excess_of_noise: float = 0.3

    def tolerated_excess(self, noise_flip: float) -> float:
        """The excess FLIP that one pair's noise may leave."""
        return self.excess + noise_flip * (self.excess_of_noise + noise_flip)


THRESHOLDS = Thresholds()
CAUSTIC_TILES = (32,)  # rare bright paths: 16 x 16 pixels hold too few for a normal mean
ALL_TILES = (16, 32)
