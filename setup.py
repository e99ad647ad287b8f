"""ament_python package: built by colcon on a stock Jazzy, installed by pip where there is none."""

from glob import glob

from setuptools import find_packages, setup

NODES = (
    "plant_simulator",
    "denoiser",
    "trajectory_generator",
    "parameter_tuner",
    "fpt_deformer",
    "recorder",
)

setup(
    name="fpt_ros",
    version="0.1.0",
    description="Adaptive control by Fixed Point Transformations as a ROS 2 node graph",
    license="Apache-2.0",
    author="The fpt_ros team",
    author_email="fpt_ros@example.com",
    maintainer="The fpt_ros team",
    maintainer_email="fpt_ros@example.com",
    python_requires=">=3.11",
    packages=find_packages(include=["fpt_ros", "fpt_ros.*"]),
    package_data={"fpt_ros.analysis": ["*.html.j2"], "fpt_ros": ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/fpt_ros"]),
        ("share/fpt_ros", ["package.xml"]),
        ("share/fpt_ros/config", glob("config/*.yaml")),
        ("share/fpt_ros/launch", glob("launch/*.launch.py")),
    ],
    install_requires=[
        "setuptools",
        "numpy",
        "scipy",
        "numba",
        "ruamel.yaml",
        "typer",
        "rich",
        "mcap>=1.6",
        "rosbags>=0.10",
        "matplotlib",
        "jinja2",
        "zstandard",
    ],
    extras_require={
        "test": ["pytest"],
    },
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "fpt = fpt_ros.cli.main:main",
            *(f"{node} = fpt_ros.nodes.{node}:main" for node in NODES),
        ],
        "fpt_ros.plants": [
            "tora = fpt_ros.plants.tora:PLANT",
            "van_der_pol = fpt_ros.plants.van_der_pol:PLANT",
        ],
        "fpt_ros.models": [
            "tora = fpt_ros.plants.tora:MODEL",
            "van_der_pol = fpt_ros.plants.van_der_pol:MODEL",
        ],
        "fpt_ros.trajectories": [
            "constant = fpt_ros.trajectories.constant:CONSTANT",
            "cosines = fpt_ros.trajectories.cosines:COSINES",
            "fitzhugh_nagumo = fpt_ros.trajectories.fitzhugh_nagumo:FITZHUGH_NAGUMO",
            "sine = fpt_ros.trajectories.sine:SINE",
            "spline = fpt_ros.trajectories.spline:SPLINE",
        ],
        "fpt_ros.disturbances": [
            "none = fpt_ros.disturbances:NONE",
            "bspline = fpt_ros.disturbances.bspline:BSPLINE",
            "lugre = fpt_ros.disturbances.lugre:LUGRE",
            "sine_noise = fpt_ros.disturbances.sine_noise:SINE_NOISE",
        ],
        "fpt_ros.transformations": [
            "rfpt = fpt_ros.transformations.rfpt:RFPT",
            "sgfpt = fpt_ros.transformations.sgfpt:SGFPT",
        ],
        "fpt_ros.tuning": ["projection = fpt_ros.tuning.projection:PROJECTION"],
        "fpt_ros.filters": [
            "none = fpt_ros.denoising.streaming.difference:DIFFERENCE",
            "fitzhugh_nagumo_observer = "
            "fpt_ros.denoising.streaming.fitzhugh_nagumo_observer:FITZHUGH_NAGUMO_OBSERVER",
        ],
    },
)
