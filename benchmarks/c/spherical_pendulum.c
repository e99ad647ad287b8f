/* Spherical pendulum (section 4.3): affine model, learning delay of ten cycles, tuned weights. */
#define N 2
#define C 2
#define TUNED 4
#define DELAY 10
#define DT 0.0001
#define CYCLE 100000
#define LAM 4.0
#include "parts.h"

static const int WHERE[] = {0, 1};
static const double START[] = {1, 0};
static const double exact[] = {0.5 * 1.5 * 1.5, 0.5 * 9.81 * 1.5};
static double attractive, weights[2], buffer[2], past[2 * DELAY + 1][2];
static long tuned;

static void begin(void)
{
    double x = 0.15;
    for (int i = 0; i < 10000; i++)
        x = atanh(0.5 * tanh(x + 0.3));
    attractive = x;
    weights[0] = weights[1] = 1;
    buffer[0] = buffer[1] = 0;
    memset(past, 0, sizeof past);
    tuned = 0;
}

static void nominal(double t, double *q, double *v, double *a)
{
    static const double offset[] = {1, 0}, A[] = {0.3, 0.5}, w[] = {2, 1};
    for (int i = 0; i < C; i++) {
        double swing = A[i] * sin(w[i] * t);
        q[i] = offset[i] + swing;
        v[i] = A[i] * w[i] * cos(w[i] * t);
        a[i] = -w[i] * w[i] * swing;
    }
}

static double relax(double n, double e, double d, double i) { return PID(n, e, d, i); }
static double weight(int i) { return weights[i]; }
static double force(double t) { return 0; }

static void deform(const double *r, const double *h, double *out)
{
    double size = norm(h, C), step = 0;
    if (size > 1e-12)
        step = (atanh(0.5 * tanh(-size + attractive + 0.3)) - attractive) / size;
    for (int i = 0; i < C; i++)
        out[i] = r[i] + step * h[i];
}

static void effort(const double *q, const double *v, const double *r, const double *s, double *out)
{
    double sin_ = sin(q[0]);
    out[0] = r[0] + 1;
    out[1] = sin_ * sin_ * r[1] + 1;
}

static void response(const double *q, const double *v, const double *Q, double *out)
{
    double cos_ = cos(q[0]), sin_ = sin(q[0]);
    const double *c = exact;
    out[0] = (Q[0] + c[0] * sin_ * cos_ * v[1] * v[1] - c[1] * sin_) / c[0];
    out[1] = (Q[1] - 2 * c[0] * sin_ * cos_ * v[0] * v[1]) / (c[0] * sin_ * sin_);
}

#include "loop.h"
static void tune(Memory *m, long k, const double *y, const double *d, double *out)
{
    if (k) {
        const int length = 2 * DELAY + 1;
        double *now = past[tuned % length];
        memcpy(now, m->last_r, sizeof m->last_r);
        if (tuned >= 2 * DELAY) {
            double *middle = past[(tuned - DELAY) % length];
            double *oldest = past[(tuned - 2 * DELAY) % length];
            for (int i = 0; i < C; i++) {
                double x = (now[i] - middle[i]) * (middle[i] - oldest[i]);
                buffer[i] = 0.99 * buffer[i] + (1 - 0.99) * (x / (fabs(x) + 1e-12));
                weights[i] = buffer[i] < 0 ? fmax(0.1, weights[i] * (1 - 50 * DT))
                                           : fmin(10, weights[i] * (1 + 0.5 * DT));
            }
        }
        tuned++;
    }
    memcpy(out, weights, sizeof weights);
}
