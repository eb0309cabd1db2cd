"""The page that each exercise opens, and words of its options."""

FOLDER_PAGES = {
    "what_the_sensor_says": "pages/0_What_the_sensor_says.py",
    "build_a_map": "pages/1_Build_a_map.py",
    "your_building": "pages/2_Your_building.py",
    "two_maps": "pages/3_Two_maps.py",
    "sweep_the_priors": "pages/5_Sweep_the_priors.py",
    "pareto_explorer": "pages/6_Pareto_explorer.py",
    "best_prior": "pages/7_Best_prior.py",
    "study": "pages/8_Study.py",
}
RULE_WORDS = {
    "prior_once": "count the drawing once",
    "subtract_prior": "take it off at every reading",
    "unseen": "where nobody looked, the pair is wrong",
    "noise": "the sensor is noisy",
    "cells": "the cells are too large",
}
"""Options that are words of a check, as they are shown."""


def shown_option(option: str) -> str:
    """An option as it is shown."""
    return RULE_WORDS.get(option, option)
