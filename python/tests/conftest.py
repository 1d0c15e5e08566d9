"""Shapes and poses that the tests share. ABUT_TEST_SEED sets the seed of the random tests; it is printed."""

import os

import numpy as np
import pytest

SEED = int(os.environ.get("ABUT_TEST_SEED", 1))


def pytest_report_header(config):
    return f"ABUT_TEST_SEED={SEED}"


@pytest.fixture
def rng(request):
    return np.random.default_rng([SEED, sum(map(ord, request.node.name))])
