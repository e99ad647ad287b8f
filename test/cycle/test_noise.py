import numpy as np

from fpt_ros.cycle.noise import BLOCK, Noise
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.experiments import experiment


def test_noise_piece_by_piece_is_that_of_the_whole_table():
    settings = ["plant_simulator.noise.position=0.1"]
    loaded = experiment.load("tora", settings=settings, duration=20.0, seed=3)
    plant = PlantSimulator(loaded.nodes["plant_simulator"])
    whole = np.reshape(plant.noise(), (plant.cycles, 6))
    noise = Noise(3, 6, plant.cycles)
    for first in range(0, plant.cycles, 777):
        cycles = np.arange(first, min(first + 777, plant.cycles))
        assert np.array_equal(noise.rows(cycles), whole[cycles])
    mixed = np.array([BLOCK + 1, 0, plant.cycles, plant.cycles - 1])  # back, and round again
    assert np.array_equal(noise.rows(mixed), whole[mixed % plant.cycles])
