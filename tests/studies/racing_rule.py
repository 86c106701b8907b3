#!/usr/bin/env python3
"""A model of one generation's selection under several rules of racing: 100 individuals of normally distributed
fitness, estimates with the error of a mean of trials (0.065 for 100), parents by tournaments of six. Prints, for
populations from diverse to nearly alike, the mean fitness of the parents in standard deviations of the population (the
selection differential), the trials, and the fitness of the winner."""
import math
import random

POPULATION, TRIALS, NOISE, REPEATS = 100, 100, 0.065, 300
draw = random.Random(1)


def make_individual(spread, points):
    """The true fitness, and the estimate after each number of trials."""
    truth, total, before, estimates = draw.gauss(0, spread), 0.0, 0, {0: 0.0}
    for trials in points:
        total += draw.gauss(0, NOISE * math.sqrt(TRIALS * (trials - before)))
        before = trials
        estimates[trials] = truth + total / trials
    return truth, estimates


def race(individuals, stages, to_the_end):
    """The trials of each after rounds by these (trials, places); only one round per stage unless to_the_end."""
    trials = [0] * len(individuals)
    rounds = 0
    while True:
        ranking = sorted(range(len(trials)), key=lambda i: -individuals[i][1][trials[i]])
        steps = {}
        for place, i in enumerate(ranking):
            following = next((stage for stage in stages if stage[0] > trials[i]), None)
            if following and place < following[1]:
                steps[i] = following[0]
        if not steps or (not to_the_end and rounds == len(stages)):
            return trials
        rounds += 1
        for i, count in steps.items():
            trials[i] = count


def observe(stages, to_the_end, spread, points):
    individuals = [make_individual(spread, points) for _ in range(POPULATION)]
    trials = race(individuals, stages, to_the_end)
    estimates = [individuals[i][1][trials[i]] for i in range(POPULATION)]
    parents = [
        individuals[max((draw.randrange(POPULATION) for _ in range(6)), key=lambda i: estimates[i])][0]
        for _ in range(2 * POPULATION)
    ]
    winner = individuals[max(range(POPULATION), key=lambda i: estimates[i])][0]
    return sum(parents) / len(parents) / spread, sum(trials), winner / spread


RULES = {
    "all 100 for everybody": ([(100, 100)], True),
    "49 for everybody": ([(49, 100)], True),
    "44 for everybody": ([(44, 100)], True),
    "20; best 25 to 100, one round": ([(20, 100), (100, 25)], False),
    "20, 40, 100 until settled": ([(20, 100), (40, 55), (100, 30)], True),
    "10, 20, 40, 100 until settled": ([(10, 100), (20, 67), (40, 45), (100, 30)], True),
    "5, 10, 20, 40, 100 until settled": ([(5, 100), (10, 75), (20, 55), (40, 41), (100, 30)], True),
}

for spread in (0.5, 0.2, 0.1, 0.05):
    print(f"Standard deviation of the population {spread}")
    for name, (stages, to_the_end) in RULES.items():
        points = [trials for trials, _ in stages]
        seen = [observe(stages, to_the_end, spread, points) for _ in range(REPEATS)]
        parents, trials, winner = (sum(column) / REPEATS for column in zip(*seen))
        print(f"  {name:34} parents {parents:5.3f}  trials {trials:6.0f}  winner {winner:5.3f}")
