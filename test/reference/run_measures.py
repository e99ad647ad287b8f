"""What bounds of runs are put on."""

from engine_runs import settled_rms, topics_of

from fpt_ros.experiments import experiment


def rms_of(name, variant="adaptive", settings=(), duration=None, settle_time=None):
    topics = topics_of(name, variant, settings, duration)
    if settle_time is None:
        settle_time = experiment.load(name, variant).about["settle_time"]
    return settled_rms(topics, settle_time)
