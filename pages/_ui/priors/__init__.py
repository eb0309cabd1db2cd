"""The pages on priors: sweeps, fronts, the best pair, the study."""
