"""The reference's reduction, tiles, and what is kept in a file."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from judge_scenes import Estimator, radiance

from raybook_grader.judge.pixels import Image, luminance
from raybook_grader.judge.reference import (
    ReferenceStatistics,
    UnusableReference,
    reduce_reference,
)
from raybook_grader.judge.tiles import Tile, spread, tile_at, tile_counts, tile_means

CHUNKS = [Estimator(radiance(40, 50)).image(seed, 4) for seed in range(64)]


def test_reduction_is_what_numpy_says_of_all_chunks_at_once() -> None:
    statistics = reduce_reference(iter(CHUNKS), spp_per_chunk=4)
    stack = np.stack(CHUNKS).astype(np.float64)
    grey = luminance(stack)
    assert (statistics.chunks, statistics.spp, statistics.shape) == (64, 256, (40, 50))
    np.testing.assert_allclose(statistics.mean, stack.mean(0), rtol=1e-6)
    np.testing.assert_allclose(statistics.pixel_variance, 4 * grey.var(0, ddof=1), rtol=1e-5)
    np.testing.assert_allclose(statistics.channel_mean, stack.mean((0, 1, 2)))
    np.testing.assert_allclose(
        statistics.channel_variance, stack.mean((1, 2)).var(0, ddof=1) / 64, rtol=1e-9
    )
    tile = grey[:, 0:16, 16:32].mean((1, 2))
    assert statistics.tile_mean[16][0, 1] == pytest.approx(tile.mean())
    assert statistics.tile_variance[16][0, 1] == pytest.approx(tile.var(ddof=1) / 64)


def test_chunks_are_taken_one_at_a_time() -> None:
    alive = 0

    def chunks() -> Iterator[Image]:
        nonlocal alive
        for chunk in CHUNKS:
            alive += 1
            yield chunk

    reduce_reference(chunks(), 4)
    assert alive == 64


def test_the_last_tiles_take_what_is_left_over() -> None:
    image = np.arange(40.0 * 50).reshape(40, 50)
    means = tile_means(image, 16)
    assert means.shape == (2, 3)
    assert means[1, 2] == pytest.approx(image[16:, 32:].mean())
    assert tile_at(5, (40, 50), 16) == Tile(32, 16, 49, 39)
    assert tile_counts((40, 50), 16).sum() == 40 * 50
    assert spread(means, (40, 50), 16)[39, 49] == means[1, 2]
    assert tile_means(image, 64).shape == (1, 1)


def test_saved_statistics_come_back(tmp_path: Path) -> None:
    statistics = reduce_reference(CHUNKS, 4)
    statistics.save(tmp_path / "r.npz")
    back = ReferenceStatistics.load(tmp_path / "r.npz")
    np.testing.assert_array_equal(back.mean, statistics.mean)
    np.testing.assert_array_equal(back.tile_variance[32], statistics.tile_variance[32])
    assert (back.chunks, back.spp) == (64, 256)
    assert [p.name for p in tmp_path.iterdir()] == ["r.npz"]


def test_other_files_and_versions_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.npz").write_bytes(b"no zip")
    with pytest.raises(UnusableReference, match="not a saved reference"):
        ReferenceStatistics.load(tmp_path / "a.npz")
    np.savez(tmp_path / "b.npz", version=99)
    with pytest.raises(UnusableReference, match="version 99, expected 1"):
        ReferenceStatistics.load(tmp_path / "b.npz")
    reduce_reference(CHUNKS, 4).save(tmp_path / "c.npz")
    (tmp_path / "c.npz").write_bytes((tmp_path / "c.npz").read_bytes()[:-400])
    with pytest.raises(UnusableReference):
        ReferenceStatistics.load(tmp_path / "c.npz")


def test_unusable_chunks_are_refused() -> None:
    with pytest.raises(UnusableReference, match="63 chunks; a reference needs at least 64"):
        reduce_reference(CHUNKS[:63], 4)
    with pytest.raises(UnusableReference, match="chunk 1 has shape"):
        reduce_reference([CHUNKS[0], CHUNKS[1][1:]], 4)
    bad = CHUNKS[0].copy()
    bad[0, 0, 0] = np.nan
    with pytest.raises(UnusableReference, match="NaN"):
        reduce_reference([bad], 4)
