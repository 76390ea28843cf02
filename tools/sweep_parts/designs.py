"""Plans of random numbers: Sobol and Latin hypercube designs over the ranges or distributions of the keys.

[Sobol1967] I. M. Sobol', USSR Comput. Math. Math. Phys. 7 (1967) 86-112, scrambled by Owen's method; [McKay1979] M. D. McKay, R. J. Beckman, W. J. Conover,
Technometrics 21 (1979) 239-245. Both by scipy.stats.qmc.
"""
import math

from needed_modules import need

from .common import SweepError

DESIGNS = ("sobol", "latin")
FORMS = "LOW:HIGH, whole:LOW:HIGH, normal:MEAN:DEVIATION or lognormal:MEAN:DEVIATION"


GREATEST_WHOLE = 2**53    # up to which each whole number is told from its neighbours


def numbers_of(text, words, count):
    """`text`: the option as it was given."""
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise SweepError(f"{text}: not a distribution. Write {FORMS}.")
    return numbers


def uniform(text, words, stats):
    low, high = numbers_of(text, words, 2)
    if low >= high:
        raise SweepError(f"{text}: the range is empty. Write LOW:HIGH with LOW below HIGH.")
    return stats.uniform(low, high - low)


def whole(text, words, stats):
    low, high = numbers_of(text, words, 2)
    if low > high or not (low.is_integer() and high.is_integer()):
        raise SweepError(f"{text}: not a range of whole numbers. Write e.g. whole:1:1000.")
    if max(-low, high) > GREATEST_WHOLE:
        raise SweepError(f"{text}: too far. Give whole numbers from {-GREATEST_WHOLE} to {GREATEST_WHOLE}.")
    return stats.randint(int(low), int(high) + 1)


def normal(text, words, stats):
    mean, deviation = numbers_of(text, words, 2)
    if deviation <= 0.0:
        raise SweepError(f"{text}: the standard deviation is {deviation:g} (must be positive).")
    return stats.norm(mean, deviation)


def lognormal(text, words, stats):
    """Mean and standard deviation are those of the value, not of its logarithm."""
    mean, deviation = numbers_of(text, words, 2)
    if mean <= 0.0 or deviation <= 0.0:
        raise SweepError(f"{text}: mean and standard deviation must be positive.")
    variance = math.log1p((deviation / mean) ** 2)
    return stats.lognorm(s=math.sqrt(variance), scale=mean * math.exp(-0.5 * variance))


def distribution(key, values, stats):
    text, (kind, *words) = f"--vary {key}={values}", values.split(":")
    kinds = {"whole": whole, "normal": normal, "lognormal": lognormal}
    return kinds[kind](text, words, stats) if kind in kinds else uniform(text, [kind, *words], stats)


def sample(kind, varied, runs, seed):
    """Texts of the values, one list a run. The same for the same words. `varied`: keys with their distributions."""
    need("numpy", "scipy")
    from scipy.stats import qmc    # not before somebody asks for a design: it takes a while
    from scipy import stats
    distributions = [distribution(key, values, stats) for key, values in varied]
    if kind == "sobol":
        if runs & (runs - 1):
            below = 1 << (runs.bit_length() - 1)
            raise SweepError(f"--runs {runs}: a Sobol design is balanced for powers of 2 only. Take {below} or {2 * below}, or --design latin.")
        points = qmc.Sobol(len(varied), scramble=True, seed=seed).random(runs)
    else:
        points = qmc.LatinHypercube(len(varied), seed=seed).random(runs)
    columns = [of_key.ppf(points[:, i]) for i, of_key in enumerate(distributions)]
    return [[written(value, *one) for value, one in zip(row, varied)] for row in zip(*columns)]


def written(value, key, values):
    if not math.isfinite(value):
        raise SweepError(f"--vary {key}={values}: gives {value}. Take another --design-seed.")
    return str(int(value)) if values.startswith("whole:") else f"{value:.10g}"
