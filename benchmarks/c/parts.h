/* What several of the loops share. */
#include <math.h>
#include <string.h>

#define PD(nominal, e, e_dot) ((nominal) + LAM * LAM * (e) + 2 * LAM * (e_dot))
#define PID(nominal, e, e_dot, i) ((nominal) + LAM * (LAM * (3 * (e) + LAM * (i)) + 3 * (e_dot)))

static double sigma(double x) { return x / (1 + fabs(x)); }

static double norm(const double *h, int n)
{
    double total = 0;
    for (int i = 0; i < n; i++)
        total += h[i] * h[i];
    return sqrt(total);
}

/* (2.23) solved by elimination: tora, and cart, beam and hamper */
static void cart_response(const double *c, const double *q, const double *v, const double *Q,
                          double *out)
{
    double cos_ = cos(q[0]), sin_ = sin(q[0]);
    double beam = c[1] - c[2], cart = c[3], coupling = c[0] * cos_;
    double torque = Q[0] - Q[1] + c[4] * sin_, push = Q[2] + c[0] * sin_ * v[0] * v[0];
    double determinant = beam * cart - coupling * coupling;
    out[0] = (torque * cart - coupling * push) / determinant;
    out[1] = Q[1] / c[2] - out[0];
    out[2] = (beam * push - coupling * torque) / determinant;
}
