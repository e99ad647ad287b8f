"""ament_python package: built by colcon on a stock Jazzy, installed by pip where there is none.

The version is in package.xml; those of all packages it needs are in requirements.lock (make lock).
"""

from glob import glob
from xml.etree import ElementTree

from setuptools import find_packages, setup

VERSION = ElementTree.parse("package.xml").findtext("version")

FIGURES = ["matplotlib", "jinja2"]
OFFLINE = ["pyarrow", "matplotlib"]
CLUSTER = ["dask", "distributed"]
PEERS = ["scikit-image", "statsmodels"]
ROBOTS = ["mujoco>=3.3"]
DESCRIPTIONS = ["gymnasium", "jvrc-description"]  # robots of others, for tests
ORACLE = ["pin>=3", "scikit-fuzzy"]  # what tests and benchmarks compare with: Pinocchio of arms
SWEEP = ["optuna>=5", "pyarrow", "matplotlib"]
# Jazzy for machines without it: wheels of the real thing (x86-64 Linux, CPython 3.10 to 3.14)
ROS = [
    "ros-jazzy-rclpy[fastrtps]",
    "ros-jazzy-std-msgs",
    "ros-jazzy-std-srvs",
    "ros-jazzy-sensor-msgs",
    "ros-jazzy-trajectory-msgs",
    "ros-jazzy-diagnostic-msgs",
    "setproctitle",  # nodes are forked, and still have names of their own
]
EXTRAS = {
    "analysis": [*FIGURES, "bokeh>=3.9"],  # fpt report, demo, gain --plot
    "sweep": SWEEP,  # fpt sweep, tune
    "compare": sorted({*FIGURES, *SWEEP}),  # fpt compare
    "export": ["pandas", "pyarrow"],  # fpt export, fpt_ros.load
    "denoise": OFFLINE,  # fpt denoise
    "thesis": sorted({*FIGURES, *OFFLINE}),  # fpt reproduce
    "robots": ROBOTS,  # arms from a file: plant and model mujoco
    "cluster": CLUSTER,  # fpt sweep --scheduler
    "peers": PEERS,  # methods of other libraries in fpt denoise and reproduce
    "ros": ROS,
    "test": [
        "pytest",
        "pytest-xdist",
        "pytest-timeout",
        "hypothesis",
        "mcap-ros2-support",
        "nbclient",
        "ipykernel",
        "colcon-common-extensions",
        "psutil",
        "pandas",
        "bokeh>=3.9",
        "websockets",  # drives a browser
        "setuptools<80",
        "wheel",
        *sorted({*DESCRIPTIONS, *FIGURES, *OFFLINE, *SWEEP, *CLUSTER, *PEERS, *ROBOTS, *ORACLE}),
    ],
    "lint": ["ruff", "mypy", "pre-commit"],
    "docs": ["sphinx", "furo", "myst-parser"],
    "bench": ["control"],
    "lock": ["uv"],  # what make installs with
}

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
    version=VERSION,
    description="Adaptive control by Fixed Point Transformations as a ROS 2 node graph",
    license="Apache-2.0",
    author="The fpt_ros team",
    author_email="fpt_ros@example.com",
    maintainer="The fpt_ros team",
    maintainer_email="fpt_ros@example.com",
    python_requires=">=3.11",
    packages=find_packages(include=["fpt_ros", "fpt_ros.*"]),
    package_data={
        "fpt_ros": ["py.typed"],
        "fpt_ros.analysis": ["*.html.j2", "*.css"],
        "fpt_ros.compare": ["*.html.j2"],
        "fpt_ros.analysis.plots": ["*.js"],
        "fpt_ros.thesis": ["*.html.j2"],
        "fpt_ros.nodes": ["*.xml"],
        "fpt_ros.plants.mujoco": ["arms/*.xml"],
    },
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/fpt_ros"]),
        ("share/fpt_ros", ["package.xml"]),
        ("share/fpt_ros/config", glob("config/*.yaml")),
        ("share/fpt_ros/config/security", glob("config/security/*.xml")),
        ("share/fpt_ros/launch", glob("launch/*.launch.py")),
        ("share/fpt_ros/layouts", glob("layouts/*.*")),
    ],
    install_requires=[
        "numpy",
        "scipy",
        "numba",
        "PyWavelets",
        "mcap>=1.6",
        "rosbags>=0.10",
        "zstandard",
        "ruamel.yaml",
        "typer",
        "rich",
    ],
    extras_require=EXTRAS,
    zip_safe=False,
    entry_points={
        "console_scripts": [
            "fpt = fpt_ros.cli.main:main",
            *(f"{node} = fpt_ros.nodes.{node}:main" for node in NODES),
        ],
        "fpt_ros.plants": [
            "acrobot = fpt_ros.plants.double_pendulum:ACROBOT",
            "affine_map = fpt_ros.plants.affine_map:PLANT",
            "cart_beam_hamper = fpt_ros.plants.cart_beam_hamper:PLANT",
            "coupled_masses = fpt_ros.plants.coupled_masses:PLANT",
            "double_pendulum = fpt_ros.plants.double_pendulum:DOUBLE_PENDULUM",
            "duffing = fpt_ros.plants.duffing:PLANT",
            "fitzhugh_nagumo = fpt_ros.plants.fitzhugh_nagumo:PLANT",
            "freeway = fpt_ros.plants.freeway:PLANT",
            "hypnosis = fpt_ros.plants.hypnosis:PLANT",
            "kapitza = fpt_ros.plants.kapitza:PLANT",
            "lorenz = fpt_ros.plants.lorenz:PLANT",
            "mimo_affine = fpt_ros.plants.mimo_affine:PLANT",
            "mujoco = fpt_ros.plants.mujoco.plant:PLANT",
            "pendubot = fpt_ros.plants.double_pendulum:PENDUBOT",
            "siso_affine = fpt_ros.plants.siso_affine:PLANT",
            "spherical_pendulum = fpt_ros.plants.spherical_pendulum:PLANT",
            "stimulated_neuron = fpt_ros.plants.stimulated_neuron:PLANT",
            "swing = fpt_ros.plants.swing:PLANT",
            "tora = fpt_ros.plants.tora:PLANT",
            "van_der_pol = fpt_ros.plants.van_der_pol:PLANT",
            "van_der_pol_second_order = fpt_ros.plants.van_der_pol_second_order:PLANT",
        ],
        "fpt_ros.models": [
            "acrobot = fpt_ros.plants.double_pendulum:ACROBOT_MODEL",
            "affine_map = fpt_ros.plants.affine_map:MODEL",
            "cart_beam_hamper = fpt_ros.plants.cart_beam_hamper:MODEL",
            "coupled_masses = fpt_ros.plants.coupled_masses:MODEL",
            "double_pendulum = fpt_ros.plants.double_pendulum:MODEL",
            "duffing = fpt_ros.plants.duffing:MODEL",
            "fitzhugh_nagumo = fpt_ros.plants.fitzhugh_nagumo:MODEL",
            "freeway = fpt_ros.plants.freeway:MODEL",
            "hypnosis = fpt_ros.plants.hypnosis:MODEL",
            "kapitza = fpt_ros.plants.kapitza:LITERAL",
            "kapitza_listing = fpt_ros.plants.kapitza:LISTING",
            "kapitza_with_gravity = fpt_ros.plants.kapitza:WITH_GRAVITY",
            "lorenz = fpt_ros.plants.lorenz:MODEL",
            "lorenz_incomplete = fpt_ros.plants.lorenz:INCOMPLETE",
            "mimo_affine = fpt_ros.plants.mimo_affine:MODEL",
            "mujoco = fpt_ros.plants.mujoco.model:MODEL",
            "mujoco_diagonal = fpt_ros.plants.mujoco.diagonal:MODEL",
            "mujoco_linear = fpt_ros.plants.mujoco.linear:MODEL",
            "pendubot = fpt_ros.plants.double_pendulum:PENDUBOT_MODEL",
            "siso_affine = fpt_ros.plants.siso_affine:MODEL",
            "spherical_affine = fpt_ros.plants.spherical_pendulum:AFFINE_MODEL",
            "spherical_fully_fuzzy = fpt_ros.plants.spherical_pendulum:FULLY_FUZZY",
            "spherical_fuzzy_sin = fpt_ros.plants.spherical_pendulum:FUZZY_SIN",
            "stimulated_neuron = fpt_ros.plants.stimulated_neuron:MODEL",
            "swing = fpt_ros.plants.swing:MODEL",
            "tora = fpt_ros.plants.tora:MODEL",
            "van_der_pol = fpt_ros.plants.van_der_pol:MODEL",
            "van_der_pol_second_order = fpt_ros.plants.van_der_pol_second_order:MODEL",
        ],
        "fpt_ros.trajectories": [
            "blended_sines = fpt_ros.trajectories.blended_sines:BLENDED_SINES",
            "cartesian_path = fpt_ros.trajectories.cartesian_path:CARTESIAN_PATH",
            "chirp = fpt_ros.trajectories.chirp:CHIRP",
            "constant = fpt_ros.trajectories.constant:CONSTANT",
            "cosines = fpt_ros.trajectories.cosines:COSINES",
            "fitzhugh_nagumo = fpt_ros.trajectories.fitzhugh_nagumo:FITZHUGH_NAGUMO",
            "duffing = fpt_ros.trajectories.duffing:DUFFING",
            "live = fpt_ros.trajectories.live:LIVE",
            "lorenz = fpt_ros.trajectories.lorenz:LORENZ",
            "inverse_kinematics = fpt_ros.trajectories.inverse_kinematics:INVERSE_KINEMATICS",
            "minimum_jerk = fpt_ros.trajectories.minimum_jerk:MINIMUM_JERK",
            "recorded = fpt_ros.trajectories.recorded:RECORDED",
            "receding_horizon = fpt_ros.trajectories.receding_horizon:RECEDING_HORIZON",
            "sine = fpt_ros.trajectories.sine:SINE",
            "spline = fpt_ros.trajectories.spline:SPLINE",
            "step = fpt_ros.trajectories.step:STEP",
            "stimulated_neuron = fpt_ros.trajectories.stimulated_neuron:STIMULATED_NEURON",
            "waypoints = fpt_ros.trajectories.waypoints:WAYPOINTS",
        ],
        "fpt_ros.relaxations": [
            "feedback_pd = fpt_ros.relaxations.feedback_pd:FEEDBACK_PD",
            "feedback_pid = fpt_ros.relaxations.feedback_pid:FEEDBACK_PID",
            "pd = fpt_ros.relaxations.pd:PD",
            "pi = fpt_ros.relaxations.pi:PI",
            "pid = fpt_ros.relaxations.pid:PID",
            "value = fpt_ros.relaxations.value:VALUE",
            "vssm = fpt_ros.relaxations.vssm:VSSM",
            "vssm_first_order = fpt_ros.relaxations.vssm_first_order:VSSM_FIRST_ORDER",
        ],
        "fpt_ros.compensators": [
            "disturbance_observer = fpt_ros.compensators.disturbance_observer:DISTURBANCE_OBSERVER",
            "incremental = fpt_ros.compensators.incremental:INCREMENTAL",
            "l1 = fpt_ros.compensators.l1:L1",
            "model_free = fpt_ros.compensators.model_free:MODEL_FREE",
            "mrac = fpt_ros.compensators.mrac:MRAC",
            "momentum_observer = fpt_ros.compensators.momentum_observer:MOMENTUM_OBSERVER",
            "none = fpt_ros.compensators.none:NONE",
            "sliding_mode = fpt_ros.compensators.sliding_mode:SLIDING_MODE",
            "state_observer = fpt_ros.compensators.state_observer:STATE_OBSERVER",
            "super_twisting = fpt_ros.compensators.super_twisting:SUPER_TWISTING",
            "time_delay = fpt_ros.compensators.time_delay:TIME_DELAY",
        ],
        "fpt_ros.disturbances": [
            "none = fpt_ros.disturbances:NONE",
            "bspline = fpt_ros.disturbances.bspline:BSPLINE",
            "kicks = fpt_ros.disturbances.kicks:KICKS",
            "lugre = fpt_ros.disturbances.lugre:LUGRE",
            "sine_noise = fpt_ros.disturbances.sine_noise:SINE_NOISE",
        ],
        "fpt_ros.integrators": [
            "dopri5 = fpt_ros.integrators.dopri5:DOPRI5",
            "explicit_euler = fpt_ros.integrators.explicit_euler:EXPLICIT_EULER",
            "rk4 = fpt_ros.integrators.rk4:RK4",
            ("semi_implicit_euler = fpt_ros.integrators.semi_implicit_euler:SEMI_IMPLICIT_EULER"),
        ],
        "fpt_ros.sensor_disturbances": [
            "biased = fpt_ros.disturbances.sensors.biased:BIASED",
            "bursts = fpt_ros.disturbances.sensors.bursts:BURSTS",
            "impulses = fpt_ros.disturbances.sensors.impulses:IMPULSES",
            "lagging = fpt_ros.disturbances.sensors.lagging:LAGGING",
            "lost = fpt_ros.disturbances.sensors.lost:LOST",
            "quantised = fpt_ros.disturbances.sensors.quantised:QUANTISED",
        ],
        "fpt_ros.actuator_disturbances": [
            "dead_zone = fpt_ros.disturbances.actuators.dead_zone:DEAD_ZONE",
            "dropouts = fpt_ros.disturbances.actuators.dropouts:DROPOUTS",
            "imprecise = fpt_ros.disturbances.actuators.imprecise:IMPRECISE",
            "lag = fpt_ros.disturbances.actuators.lag:LAG",
            "late = fpt_ros.disturbances.actuators.late:LATE",
            "response = fpt_ros.disturbances.actuators.response:RESPONSE",
            "saturation = fpt_ros.disturbances.actuators.saturation:SATURATION",
        ],
        "fpt_ros.transformations": [
            "none = fpt_ros.transformations.none:NONE",
            "atanh = fpt_ros.transformations.atanh:ATANH",
            "rotation = fpt_ros.transformations.rotation:ROTATION",
            "rfpt = fpt_ros.transformations.rfpt:RFPT",
            "sgfpt = fpt_ros.transformations.sgfpt:SGFPT",
            "stretched = fpt_ros.transformations.stretched:STRETCHED",
        ],
        "fpt_ros.tuning": [
            "damped = fpt_ros.tuning.pseudo_inverse:DAMPED",
            "fixed_point = fpt_ros.tuning.fixed_point:FIXED_POINT",
            "gain = fpt_ros.tuning.gain:CALCULATED",
            "gram_schmidt = fpt_ros.tuning.gram_schmidt:GRAM_SCHMIDT",
            "none = fpt_ros.tuning.none:NONE",
            "lyapunov = fpt_ros.tuning.lyapunov:LYAPUNOV",
            "moore_penrose = fpt_ros.tuning.pseudo_inverse:MOORE_PENROSE",
            "projection = fpt_ros.tuning.projection:PROJECTION",
            "slotine_li = fpt_ros.tuning.slotine_li:SLOTINE_LI",
            "truncated_svd = fpt_ros.tuning.truncated_svd:TRUNCATED_SVD",
            "weights = fpt_ros.tuning.weights:TUNED_WEIGHTS",
        ],
        "fpt_ros.filters": [
            "adaptive_savgol = fpt_ros.denoising.streaming.adaptive_savgol:ADAPTIVE_SAVGOL",
            "alpha_beta_gamma = fpt_ros.denoising.streaming.alpha_beta_gamma:ALPHA_BETA_GAMMA",
            "butterworth = fpt_ros.denoising.streaming.butterworth:BUTTERWORTH",
            "high_gain = fpt_ros.denoising.streaming.high_gain:HIGH_GAIN",
            "levant = fpt_ros.denoising.streaming.levant:LEVANT",
            "one_euro = fpt_ros.denoising.streaming.one_euro:ONE_EURO",
            "finite_difference = fpt_ros.denoising.streaming.finite_difference:FINITE_DIFFERENCE",
            "fuzzy = fpt_ros.denoising.streaming.fuzzy:FUZZY",
            "kalman_bank = fpt_ros.denoising.streaming.kalman_bank:KALMAN_BANK",
            "savgol = fpt_ros.denoising.streaming.savgol:SAVGOL",
            "wavelet = fpt_ros.denoising.streaming.wavelet:WAVELET",
            "none = fpt_ros.denoising.streaming.difference:DIFFERENCE",
            (
                "fitzhugh_nagumo_observer = "
                "fpt_ros.denoising.streaming.fitzhugh_nagumo_observer:FITZHUGH_NAGUMO_OBSERVER"
            ),
        ],
        "fpt_ros.denoisers": [
            "adaptive_savgol = fpt_ros.denoising.offline.adaptive_savgol:ADAPTIVE_SAVGOL",
            "anytime = fpt_ros.denoising.offline.anytime:ANYTIME",
            "auto = fpt_ros.denoising.offline.auto:AUTO",
            "bayesshrink = fpt_ros.denoising.offline.peers:BAYESSHRINK",
            "fuzzy = fpt_ros.denoising.offline.fuzzy:FUZZY",
            "heursure = fpt_ros.denoising.offline.heursure:HEURSURE",
            "improved = fpt_ros.denoising.offline.improved:IMPROVED",
            "lowess = fpt_ros.denoising.offline.peers:LOWESS",
            "median_savgol = fpt_ros.denoising.offline.peers:MEDIAN_SAVGOL",
            "minimax = fpt_ros.denoising.offline.minimax:MINIMAX",
            "savgol = fpt_ros.denoising.offline.savgol:SAVGOL",
            "savgol_bank = fpt_ros.denoising.offline.savgol_bank:SAVGOL_BANK",
            "soft_universal = fpt_ros.denoising.offline.peers:SOFT_UNIVERSAL",
            "sureshrink = fpt_ros.denoising.offline.sureshrink:SURESHRINK",
            "undecimated = fpt_ros.denoising.offline.undecimated:UNDECIMATED",
            "universal = fpt_ros.denoising.offline.universal:UNIVERSAL",
            "visushrink = fpt_ros.denoising.offline.peers:VISUSHRINK",
        ],
    },
)
