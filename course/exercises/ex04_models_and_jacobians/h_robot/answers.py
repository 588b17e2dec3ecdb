# %% way: complex step
def H_robot(x, p, e=1e-30):
    def see(x):
        dx, dy = p[0] - x[0], p[1] - x[1]
        return np.array([np.sqrt(dx**2 + dy**2), np.arctan(dy / dx) - x[2]])
    return np.column_stack([np.imag(see(x + 1j * e * one)) / e for one in np.eye(3)])

# %% way: sympy
import functools
import sympy as sp

@functools.cache
def derived():
    x, y, t, a, b = sp.symbols("x y t a b", real=True)
    model = sp.Matrix([sp.sqrt((a - x)**2 + (b - y)**2), sp.atan2(b - y, a - x) - t])
    return sp.lambdify([(x, y, t), (a, b)], model.jacobian([x, y, t]))

def H_robot(x, p):
    return derived()(x, p)

# %% way: unit vectors, as a list
def H_robot(x, p):
    offset = np.subtract(p, x[:2])
    r = np.linalg.norm(offset)
    c, s = offset / r
    return [[-c, -s, 0], [s / r, -c / r, -1]]

# %% way: from range and bearing
def H_robot(x, p):
    r, bearing = h(x, p)
    c, s = np.cos(x[2] + bearing), np.sin(x[2] + bearing)
    H = np.zeros((2, 3))
    H[0, :2] = -c, -s
    H[1] = s / r, -c / r, -1
    return H

# %% right: complex: the derivative of a logarithm
def H_robot(x, p):
    w = complex(p[0] - x[0], p[1] - x[1])
    q = 1 / w
    r = abs(w)
    return [[-w.real / r, -w.imag / r, 0.0], [-q.imag, -q.real, -1.0]]

# %% right: polar form
def H_robot(x, p):
    offset = np.asarray(p, float) - np.asarray(x, float)[:2]
    r = np.linalg.norm(offset)
    phi = np.arctan2(offset[1], offset[0])
    H = np.zeros((2, 3))
    H[0, :2] = -np.cos(phi), -np.sin(phi)
    H[1, :2] = np.sin(phi) / r, -np.cos(phi) / r
    H[1, 2] = -1
    return H

# %% right: stacked from unit vector and its quarter turn
def H_robot(x, p):
    n = p - x[:2]
    r = np.hypot(*n)
    n = n / r
    side = np.array([-n[1], n[0]])
    return np.vstack([np.append(-n, 0), np.append(-side / r, -1)])

# %% wrong: central differences of h
def H_robot(x, p):
    steps = 1e-6 * np.eye(3)
    H = np.column_stack([h(x + step, p) - h(x - step, p) for step in steps])
    H[1] = (H[1] + np.pi) % (2 * np.pi) - np.pi
    return H / 2e-6

# %% wrong: changes p in place
def H_robot(x, p):
    p -= x[:2]
    r = np.sqrt(p[0] ** 2 + p[1] ** 2)
    return np.array([[-p[0] / r, -p[1] / r, 0], [p[1] / r**2, -p[0] / r**2, -1]])

# %% wrong: a guard against division by zero that bites near landmarks
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    r = max(np.hypot(dx, dy), 0.5)
    return np.array([[-dx / r, -dy / r, 0], [dy / r**2, -dx / r**2, -1]])

# %% wrong: transposed: one row for x, y, theta
def H_robot(x, p):
    dx, dy = p - x[:2]
    q = dx * dx + dy * dy
    r = q**0.5
    by_x = [-dx / r, dy / q]
    by_y = [-dy / r, -dx / q]
    by_theta = [0, -1]
    return np.array([by_x, by_y, by_theta])

# %% wrong: distances without sign (abs)
def H_robot(x, p):
    dx, dy = np.abs(np.asarray(p) - x[:2])
    r = np.sqrt(dx**2 + dy**2)
    return np.array([[-dx / r, -dy / r, 0], [dy / r**2, -dx / r**2, -1]])

# %% wrong: slope dy/dx instead of atan2
def H_robot(x, p):
    dx, dy = p[0] - x[0], p[1] - x[1]
    r = np.sqrt(dx**2 + dy**2)
    slope = dy / dx
    by_x = slope / dx / (1 + slope**2) if dx > 0 else -slope / dx / (1 + slope**2)
    return np.array([[-dx / r, -dy / r, 0], [by_x, -1 / dx / (1 + slope**2), -1]])
