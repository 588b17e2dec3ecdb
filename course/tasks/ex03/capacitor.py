"""Programs of task 03-capacitor."""

from course.tasks import Slip, Stumble

TASK = "03-capacitor"

WAYS = {
    "by entries": """
def capacitor(dt, ohms, farads, sigma):
    tau = ohms * farads
    e = np.exp(-dt / tau)
    g, q = 1 - e, sigma**2 * dt
    F = [[e, g], [0, 1]]
    Q = [[q * g**2, q * g], [q * g, q]]
    H = [[1, 0], [-1 / ohms, 1 / ohms]]
    return F, Q, H
""",
    "carried by F": """
def capacitor(dt, ohms, farads, sigma):
    share = -np.expm1(-dt / ohms / farads)
    F = np.array([[1 - share, share], [0, 1]])
    at_first = np.diag([0, sigma**2 * dt])
    return F, F @ at_first @ F.T, np.array([[1, 0], np.array([-1, 1]) / ohms])
""",
    "matrix exponential": """
def capacitor(dt, ohms, farads, sigma):
    rate = 1 / (ohms * farads)
    A = np.array([[-rate, rate], [0, 0]])
    values, vectors = np.linalg.eig(A)
    F = np.real(vectors @ np.diag(np.exp(values * dt)) @ np.linalg.inv(vectors))
    g = F[:, 1:] * sigma * dt**0.5
    return F, g @ g.T, np.array([[ohms, 0], [-1, 1]]) / ohms
""",
    "by differences": """
def capacitor(dt, ohms, farads, sigma):
    def step(state, w):
        volts, source = state
        source = source + w
        return np.array([source + (volts - source) * np.exp(-dt / (ohms * farads)), source])

    def meters(state):
        return np.array([state[0], (state[1] - state[0]) / ohms])

    units = np.eye(2)
    F = np.column_stack([step(unit, 0) - step(units[0] * 0, 0) for unit in units])
    w = step(units[0] * 0, 1)[:, None]
    return F, sigma**2 * dt * w @ w.T, np.column_stack([meters(unit) for unit in units])
""",
}

PASTED = {
    "the lesson's cart": """
def capacitor(dt, ohms, farads, sigma):
    F = np.array([[1, dt], [0, 1]])
    Q = np.diag([0.02, 0.05]) ** 2
    H = np.array([[1.0, 0.0], [0.0, 1.0]])
    return F, Q, H
""",
    "the cart with a random push": """
def capacitor(dt, ohms, farads, sigma):
    F = np.array([[1, dt], [0, 1]])
    G = np.array([[dt**2 / 2], [dt]])
    return F, sigma**2 * G @ G.T, np.array([[1.0, 0.0], [1.0, 0.0]])
""",
    "nothing happens": """
def capacitor(dt, ohms, farads, sigma):
    return np.eye(2), sigma**2 * np.eye(2), np.eye(2)
""",
}

LEFT = "np.exp(-dt / (ohms * farads))"
JUMP = "np.array([1 - left, 1])"
Q = "sigma**2 * dt * np.outer(jump, jump)"
H = "[-1 / ohms, 1 / ohms]"

SLIPS = (
    Slip(
        "what-was-gained",
        "Left and gained are mixed up: of the old difference a share is left, and that share is 1 when "
        "no time passes.",
        (LEFT, "1 - np.exp(-dt / (ohms * farads))"),
        ("F = np.array([[left, 1 - left]", "F = np.array([[1 - left, left]"),
    ),
    Slip(
        "grows",
        "The exponent has the wrong sign: the difference between the voltages grows in your step.",
        (LEFT, "np.exp(dt / (ohms * farads))"),
    ),
    Slip(
        "straight-line",
        "You took the curve for a straight line, as for a very short step: a long step would leave less "
        "than nothing of the difference.",
        (LEFT, "1 - dt / (ohms * farads)"),
        (LEFT, "1 / (1 + dt / (ohms * farads))"),
    ),
    Slip(
        "time-constant",
        "The time constant is wrong: τ is the product of resistance and capacitance, and time is "
        "measured in units of it.",
        (LEFT, "np.exp(-dt / ohms)"),
        (LEFT, "np.exp(-dt / farads)"),
        (LEFT, "np.exp(-dt * ohms * farads)"),
        (LEFT, "np.exp(-dt / ohms * farads)"),
        (LEFT, "np.exp(-dt / (ohms + farads))"),
        (LEFT, "np.exp(-1 / (ohms * farads))"),
        (LEFT, "2 ** (-dt / (ohms * farads))"),
    ),
    Slip(
        "source-forgotten",
        "The source does nothing to the capacitor: with an empty capacitor and a source of 1 V the "
        "capacitor stays empty.",
        ("[left, 1 - left]", "[left, 0]"),
    ),
    Slip(
        "source-added",
        "The whole voltage of the source is added in each step: with both voltages the same nothing "
        "should happen at all.",
        ("[left, 1 - left]", "[left, 1]"),
        ("[left, 1 - left]", "[1, 1 - left]"),
    ),
    Slip(
        "F-transposed",
        "F is transposed: a row tells how one new voltage is made of both old ones, and the capacitor "
        "has no effect on the source.",
        ("F = np.array([[left, 1 - left], [0, 1]])", "F = np.array([[left, 0], [1 - left, 1]])"),
    ),
    Slip(
        "order-of-states",
        "The states stand in the wrong order: the capacitor is the first one, the source the second.",
        ("[[left, 1 - left], [0, 1]]", "[[1, 0], [1 - left, left]]"),
        (JUMP, "np.array([1, 1 - left])"),
        ("[[1, 0], " + H + "]", "[[0, 1], [1 / ohms, -1 / ohms]]"),
    ),
    Slip(
        "source-fades",
        "The source loses its voltage in your step. It keeps it, but for the jump.",
        ("[0, 1]]", "[0, left]]"),
        ("[0, 1]]", "[0, 0]]"),
    ),
    Slip(
        "jump-at-the-end",
        "In your Q only the source is wrong after the step. It jumps at the beginning: what has the "
        "capacitor done since?",
        (JUMP, "np.array([0, 1])"),
        (Q, "np.diag([0, sigma**2 * dt])"),
    ),
    Slip(
        "cross-terms",
        "The cross terms of Q are missing. Both voltages are wrong because of the same jump, so their "
        "errors go together.",
        (Q, "sigma**2 * dt * np.diag(jump**2)"),
    ),
    Slip(
        "two-jumps",
        "Both voltages jump by themselves in your Q. There is one jump, and it is the source's.",
        (Q, "sigma**2 * dt * np.eye(2)"),
        (JUMP, "np.array([1, 1])"),
    ),
    Slip(
        "Q-of-the-left",
        "The capacitor takes on that share of the jump which it gains in a step, not the share that "
        "is left of a difference.",
        (JUMP, "np.array([left, 1])"),
    ),
    Slip(
        "sigma-not-squared",
        "Q holds variances: a factor of the error stands in it squared.",
        (Q, "sigma * dt * np.outer(jump, jump)"),
        (Q, "sigma * np.sqrt(dt) * np.outer(jump, jump)"),
        (Q, "sigma**2 * dt * np.sqrt(np.outer(jump, jump))"),
    ),
    Slip(
        "dt-in-Q",
        "Q depends on dt in another way: the variance of a source that wanders grows in proportion to "
        "the time.",
        (Q, "sigma**2 * np.outer(jump, jump)"),
        (Q, "sigma**2 * dt**2 * np.outer(jump, jump)"),
        (Q, "sigma**2 / dt * np.outer(jump, jump) if dt else np.zeros((2, 2))"),
        (Q, "sigma**2 * np.sqrt(dt) * np.outer(jump, jump)"),
    ),
    Slip(
        "Q-of-the-cart",
        "This Q, with dt⁴ / 4, is that of a cart with a random push. Write the error that one volt of "
        "the jump leaves in each of your two states.",
        (JUMP, "np.array([dt / 2, 1]) * np.sqrt(dt)"),
        (JUMP, "np.array([dt**2 / 2, dt])"),
        (JUMP, "np.array([dt, 1])"),
    ),
    Slip(
        "wandering-on",
        "In your Q the source wanders all through the step. Here it makes one jump at the beginning and "
        "then keeps its voltage.",
        (
            "Q = " + Q,
            "a = np.exp(-np.linspace(0.0005, 0.9995, 1000) * dt / (ohms * farads))\n"
            "    j = np.stack([1 - a, np.ones(1000)])\n    Q = sigma**2 * dt * j @ j.T / 1000",
        ),
    ),
    Slip(
        "carried-twice",
        "The jump went through F twice: its error passes through one step only.",
        (Q, "F @ (sigma**2 * dt * np.outer(jump, jump)) @ F.T"),
    ),
    Slip(
        "sign-of-the-jump",
        "One of the signs in the jump's error is wrong: when the source jumps up, the capacitor follows "
        "it upwards.",
        (JUMP, "np.array([left - 1, 1])"),
    ),
    Slip(
        "current-sign",
        "The current has the wrong sign: it charges the capacitor while the source is higher.",
        (H, "[1 / ohms, -1 / ohms]"),
    ),
    Slip(
        "volts-for-amperes",
        "The ammeter shows a voltage in your H. What makes amperes of volts?",
        (H, "[-1, 1]"),
        (H, "[-ohms, ohms]"),
    ),
    Slip(
        "one-voltage",
        "The current depends on the difference of both voltages: one of them is missing, or they are "
        "added.",
        (H, "[0, 1 / ohms]"),
        (H, "[-1 / ohms, 0]"),
        (H, "[1 / ohms, 0]"),
        (H, "[1 / ohms, 1 / ohms]"),
    ),
    Slip(
        "current-as-derivative",
        "The ammeter shows the current through the resistor, in amperes: volts per ohm, without the "
        "capacitance.",
        (H, "[-1 / (ohms * farads), 1 / (ohms * farads)]"),
        (H, "[-farads / ohms, farads / ohms]"),
        (H, "[-farads, farads]"),
    ),
    Slip(
        "meters-swapped",
        "The meters stand in the wrong order: the voltmeter is the first row of H, the ammeter the "
        "second.",
        ("[[1, 0], " + H + "]", "[" + H + ", [1, 0]]"),
    ),
    Slip(
        "wrong-voltmeter",
        "The voltmeter hangs on the capacitor, and shows its voltage alone.",
        ("[[1, 0], " + H + "]", "[[0, 1], " + H + "]"),
        ("[[1, 0], " + H + "]", "[[1, 1], " + H + "]"),
        ("[[1, 0], " + H + "]", "[[-1, 1], " + H + "]"),
        ("[[1, 0], " + H + "]", "[[1, -1], " + H + "]"),
    ),
    Slip(
        "H-transposed",
        "H is transposed: each row is a meter, and each column a voltage.",
        ("[[1, 0], " + H + "]", "[[1, -1 / ohms], [0, 1 / ohms]]"),
    ),
    Slip(
        "meters-after-F",
        "F is in your H. The meters are read of the state as it is then; the filter has moved it before.",
        ("return F, Q, H", "return F, Q, H @ F"),
    ),
    Slip(
        "order-of-results",
        "Two matrices stand in each other's place: F comes first, then Q, then H.",
        ("return F, Q, H", "return F, H, Q"),
        ("return F, Q, H", "return Q, F, H"),
        ("return F, Q, H", "return H, Q, F"),
    ),
    Slip(
        "whole-numbers",
        "Your matrix holds whole numbers only: an array made of integers cuts off what is put into it.",
        (
            "F = np.array([[left, 1 - left], [0, 1]])",
            "F = np.array([[left, 1 - left], [0, 1]]).astype(int)",
        ),
        ("return F, Q, H", "return F, Q, H.astype(int)"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("return F, Q, H", "return F, Q"),
        ("return F, Q, H", "return F, Q, H[:1]"),
        ("return F, Q, H", "return F, jump, H"),
        ("np.outer(jump, jump)", "(jump @ jump)"),
        ("return F, Q, H", "F, Q, H"),
    ),
    Stumble(
        "raised",
        (LEFT, "math.exp(-dt / (ohms * farads))"),
        ("np.outer(jump, jump)", "jump @ jump.T @ F.T @ F @ Q"),
    ),
)

EQUIVALENT = {}
