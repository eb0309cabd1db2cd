"""How hypothesis runs: without a clock, and with the same examples each time in CI."""

import os

from hypothesis import HealthCheck, settings

# A busy machine is no fault of the code: no test fails because it took long.
settings.register_profile(
    "here", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("ci", settings.get_profile("here"), derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "here")
