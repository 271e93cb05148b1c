"""Which effect, or which two or three of them, explain a log: the stages of the search, in order.

Every effect of the vocabulary is screened, and the most promising are fitted, on the decimated
log; the best of these are then fitted on the log itself. If none of them brings the residual to the
noise floor, every pair of a leading effect with any other is screened, and so on as before. If one
does, but a second effect promises to take more off than noise could, that pair is fitted as well. Where
no pair does, every effect beside each of the leading pairs is. Where two or three effects nearly explain
it, another one is tried in place of each of them. Where dry friction leads, the angle by which it gives
before it slides may be another one. Noise of 1/f that shows itself, and is all that is
left, is allowed for before any of that. What the scatter of the rig's own constants explains is `none`.
Where nothing explains the log, elastic tissue may go along with a sliding shaft, clocks may have run
before the trials, noise may grow with rate or torque or differ from trial to trial, outliers may be
left, noise may be weakly coloured or of 1/f, the torque may drift, readings may jump, and those of the
tip may drift. What is far above the noise all the same is compared with plainer sets that leave hardly
more.

Each stage takes the state of the search and returns the next; its record says what it made, kept and
dropped.
"""

from diagnosis.selection.stages.best import (
    best_to_its_end,
    best_without_each_effect,
    plainer_sets,
    scatter_of_the_best,
)
from diagnosis.selection.stages.exchange import exchanges, exchanges_in_the_best
from diagnosis.selection.stages.late_sensors import imperfections_in_place
from diagnosis.selection.stages.laws.dragged_tissue import tissue_that_goes_along
from diagnosis.selection.stages.laws.presliding import presliding_of_dry_friction
from diagnosis.selection.stages.mesh_refinement import finer_mesh, finer_mesh_near_the_floor
from diagnosis.selection.stages.nominal_rig import nominal_rig, stiffness_or_damping_alone
from diagnosis.selection.stages.pairs import pairs
from diagnosis.selection.stages.richer_effects import (
    richer_effects,
    richer_effects_in_place_of_three,
    richer_effects_in_the_best,
    simpler_effects,
)
from diagnosis.selection.stages.sensors.clock_starts import clocks_before_trials
from diagnosis.selection.stages.sensors.coloured_noise import (
    coloured_noise,
    flicker_noise,
    flicker_noise_that_shows,
    noise_of_the_best,
    weakly_coloured_noise,
)
from diagnosis.selection.stages.sensors.drift_or_offset import drift_or_offset
from diagnosis.selection.stages.sensors.growing_noise import noise_that_grows
from diagnosis.selection.stages.sensors.imperfections import (
    imperfections_beside_three,
    imperfections_of_sensors,
)
from diagnosis.selection.stages.sensors.noise_by_trial import noise_of_each_trial
from diagnosis.selection.stages.sensors.outliers_left import (
    outliers_and_more,
    outliers_beside_the_best,
)
from diagnosis.selection.stages.sensors.reading_jumps import jumps_and_more, jumps_of_readings
from diagnosis.selection.stages.sensors.sensor_drift import (
    drift_of_the_tip_sensor,
    drift_of_the_torque_sensor,
)
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.selection.stages.stage import Stage, run_stages
from diagnosis.selection.stages.starts_left import starts_and_more, starts_of_trials
from diagnosis.selection.stages.triples import three_effects
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

OF_EFFECTS: tuple[Stage, ...] = (
    nominal_rig,
    stiffness_or_damping_alone,
    single_effects,
    coloured_noise,
    finer_mesh_near_the_floor,
    stiffness_or_damping_alone,
    richer_effects,
    flicker_noise_that_shows,
    pairs,
    richer_effects,
    imperfections_of_sensors,
    stiffness_or_damping_alone,
    flicker_noise_that_shows,
    presliding_of_dry_friction,
    three_effects,
    richer_effects_in_place_of_three,
    exchanges,
    imperfections_beside_three,
    exchanges_in_the_best,
    presliding_of_dry_friction,
    best_to_its_end,
    noise_of_the_best,
    imperfections_in_place,
    best_without_each_effect,
    richer_effects_in_the_best,
    scatter_of_the_best,
    flicker_noise_that_shows,
    finer_mesh,
)
"""Which effects explain the log."""
OF_THE_RECORDING: tuple[Stage, ...] = (
    tissue_that_goes_along,
    starts_of_trials,
    clocks_before_trials,
    noise_that_grows,
    noise_of_each_trial,
    outliers_beside_the_best,
    weakly_coloured_noise,
    flicker_noise,
    drift_of_the_torque_sensor,
    jumps_and_more((flicker_noise, drift_of_the_torque_sensor)),
    drift_of_the_tip_sensor,
    starts_and_more((drift_of_the_torque_sensor, drift_of_the_tip_sensor)),
    outliers_and_more(
        (
            weakly_coloured_noise,
            flicker_noise,
            drift_of_the_torque_sensor,
            jumps_of_readings,
            drift_of_the_tip_sensor,
        )
    ),
    drift_or_offset,
    scatter_of_the_best,
    finer_mesh,
    simpler_effects,
    imperfections_in_place,
    best_without_each_effect,
    plainer_sets,
)
"""What else a recording may have, where none does; and what is asked of any explanation."""
STAGES = (*OF_EFFECTS, *OF_THE_RECORDING)


def search(state: SearchState, workers: Workers) -> SearchState:
    """The state after all stages that there was time for."""
    return run_stages(STAGES, state, workers)
