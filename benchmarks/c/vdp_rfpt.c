/* Fifth order van der Pol oscillator (section 2.3): RFPT, tuning by projection, a disturbance. */
#define N 1
#define C 1
#define TUNED 8
#define DELAY 1
#define DT 0.001
#define CYCLE 1000000
#define LAM 10.0
#include "parts.h"

static const int WHERE[] = {0};
static const double START[] = {0};
static const double exact[] = {10, 1, 3, 100, 1, 2};
static double model[6];

static void begin(void)
{
    const double start[] = {9, 2, 7, 110, 0.9, 1.5};
    memcpy(model, start, sizeof start);
}

static void nominal(double t, double *q, double *v, double *a)
{
    double swing = 1.5 * sin(2 * t);
    q[0] = swing;
    v[0] = 3 * cos(2 * t);
    a[0] = -4 * swing;
}

static double relax(double n, double e, double d, double i) { return PD(n, e, d); }
static double weight(int i) { return 1; }

static double force(double t)
{
    static const int points[] = {0, 30, 60, 20, -40, -70, -30, 10, 50, 40, -20, -50};
    long knot = (long)floor(t);
    double s = t - knot, u = 1 - s;
    double b1 = (3 * s - 6) * s * s + 4, b2 = ((-3 * s + 3) * s + 3) * s + 1;
    return 100 * (u * u * u * (points[knot % 12] / 70.0) + b1 * (points[(knot + 1) % 12] / 70.0)
                  + b2 * (points[(knot + 2) % 12] / 70.0)
                  + s * s * s * (points[(knot + 3) % 12] / 70.0)) / 6;
}

static void deform(const double *r, const double *h, double *out)
{
    out[0] = (r[0] - 1e5) * (1 + sigma(1e-6 * h[0])) + 1e5;
}

static double spring(const double *c, double q, double v)
{
    double q2 = q * q;
    return (c[1] * q2 - c[2]) * v + (c[3] + (c[4] + c[5] * q2) * q2) * q;
}

static void effort(const double *q, const double *v, const double *r, const double *s, double *out)
{
    out[0] = model[0] * r[0] + spring(model, q[0], v[0]);
}

static void response(const double *q, const double *v, const double *Q, double *out)
{
    out[0] = (Q[0] - spring(exact, q[0], v[0])) / exact[0];
}

#include "loop.h"
static void tune(Memory *m, long k, const double *y, const double *d, double *out)
{
    if (k) {
        double q = m->last_q[0], v = m->last_v[0], q2 = q * q, known = 0, square = 1e-6;
        double Y[] = {y[0], q2 * v, -v, q, q2 * q, q2 * q2 * q};
        for (int j = 0; j < 6; j++)
            known += Y[j] * model[j];
        for (int j = 0; j < 6; j++)
            square += Y[j] * Y[j];
        double factor = (m->last_effort[0] - known) / square;
        for (int j = 0; j < 6; j++)
            model[j] += DT * (factor * Y[j]);
    }
    memcpy(out, model, sizeof model);
}
