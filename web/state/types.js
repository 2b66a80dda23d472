// Types of what the program sends. World frame: z up, m, rad, s; bodies and sensors are counted from 1.

/** @typedef {{x: number, y: number, z: number}} Vector */
/** @typedef {{x: number, y: number, z: number, w: number}} Quaternion world_from_body */
/** @typedef {'starting' | 'tracking' | 'degraded' | 'lost' | 'relocated'} TrackingState */
/** @typedef {'matched' | 'not-found' | 'outlier' | 'unconfirmed' | 'not-searched' | 'initialized'} Outcome */

/** @typedef {{frame: number, t: number, kind: string, text: string}} RunEvent */
/** @typedef {{width: number, height: number, fx: number, fy: number, cx: number, cy: number}} Camera */
/** @typedef {{min: number[], max: number[]}} Box */
/** @typedef {{origin: number[], step_m: number, columns: number, rows: number, heights: number[]}} Terrain */

/**
 * @typedef {object} Info what is known of a run before its first frame
 * @property {string} name of the scenario; of the run directory of a recorded run
 * @property {string} [scenario] of a recorded run
 * @property {number} seed
 * @property {'camera' | 'vehicle'} body
 * @property {number} bodies
 * @property {number} rate_hz
 * @property {number} expected_frames 0: unknown
 * @property {number} patch_size_px
 * @property {boolean} [same_frame_as_truth]
 * @property {boolean} [scale_known]
 * @property {Camera} [camera]
 * @property {Box & {boxes?: Box[]}} [room]
 * @property {Terrain} [terrain]
 * @property {{source: string, width: number, height: number}} [live_camera] from which the run takes its images
 * @property {string} [effective_toml]
 * @property {string[]} [disturbances]
 * @property {boolean} [manual]
 * @property {string[]} [strategies]
 * @property {string[]} [gazes]
 * @property {string} [strategy] in force
 * @property {string} [gaze] in force
 * @property {Disturbed} [disturbed] of a live run
 */

/** Disturbances in force. @typedef {{covered: boolean, sigma_gray: number, factor: number}} Disturbed */

/**
 * @typedef {object} Match
 * @property {number} id
 * @property {'anchor' | 'landmark' | 'ray' | 'body'} kind
 * @property {Outcome} outcome
 * @property {number} body
 * @property {number} sensor
 * @property {boolean} image whether the measurement is an image position, px
 * @property {number[]} [predicted]
 * @property {number[]} [innovation_cov] s11, s12, s22
 * @property {number[]} [measured]
 * @property {number} [correlation]
 * @property {number[][]} [particles] u, v, weight
 */

/**
 * @typedef {object} Body
 * @property {TrackingState} state
 * @property {Vector} [position]
 * @property {Quaternion} [orientation]
 * @property {number[]} [pose_covariance] 36 numbers, row-major
 * @property {{position: Vector, orientation: Quaternion}} [truth]
 * @property {boolean} [operator_controlled]
 * @property {boolean} [manual] taken over by an operator of the page
 * @property {{decided: boolean, chosen: number, candidates: {action: string, score?: number | null}[]}}
 *   [decision]
 */

/**
 * @typedef {{id: number, kind: 'anchor' | 'landmark', detections: number, position?: Vector, covariance?:
 *   number[]}} Landmark without what is not finite
 */
/** @typedef {{min: number[], cell_m: number, cells: number[], seen: string}} Exploration */

/**
 * @typedef {object} Snapshot
 * @property {number} frame
 * @property {number} t
 * @property {TrackingState} state
 * @property {string} reason
 * @property {number} matched
 * @property {number} predicted
 * @property {number} [nis]
 * @property {number} [nis_dof]
 * @property {{vehicle?: number, map?: number, total?: number}} [entropy]
 * @property {number} [entropy_extended]
 * @property {number} [coverage]
 * @property {number} [mapped]
 * @property {Body[]} bodies
 * @property {Match[]} matches
 * @property {number[]} [landmark_ids]
 * @property {Landmark[]} [landmarks]
 * @property {Exploration} [exploration]
 * @property {({type: string, settings?: string[]} & Partial<Disturbed>)[]} [interventions] that took effect before this frame
 */

/**
 * @typedef {{estimate: (number[] | null)[], truth?: (number[] | null)[]}} SeriesPath positions of one body,
 *   per frame
 */

/**
 * @typedef {object} SeriesMessage
 * @property {number[]} t
 * @property {TrackingState[]} state
 * @property {Record<string, (number | null)[]>} columns
 * @property {Record<string, (number | null)[]>} timing_ms
 * @property {RunEvent[]} events
 * @property {number} frames
 * @property {number} first_frame
 * @property {number} [frame_step] frames from one row to the next; 1 if it is not said
 * @property {SeriesPath[]} [paths] one per body
 */

/**
 * @typedef {{running: boolean, paused: boolean, speed: number, viewers: number, ended: {status: string,
 *   reason: string} | null, robot_stopped?: boolean | null}} LoopState
 */
/**
 * How saving the state of the run went.
 * @typedef {object} Saved
 * @property {number} t of the last frame in it, s
 * @property {string} file in the run directory
 * @property {number} bytes
 * @property {string | null} failure why it could not be written
 */
/** @typedef {{lines: string[], directions: {name: string, observable: boolean}[]}} Observability */
/**
 * @typedef {{mode: 'live' | 'replay' | 'laboratory', version: string, runs: {name: string}[], control?:
 *   boolean, kind?: string}} Mode
 */
/**
 * @typedef {{key: string, value: any, unit: string, default: any, source: string, allowed: string, help:
 *   string, options?: string[]}} Setting
 */

export {};
