/* Cart, beam and hamper (section 2.4): RFPT, tuning by Gram-Schmidt orthogonalisation. */
#define N 3
#define C 3
#define TUNED 7
#define DELAY 1
#define DT 0.0001
#define CYCLE 100000
#define LAM 10.0
#include "parts.h"

static const int WHERE[] = {0, 1, 2};
static const double START[] = {0, 0, 0};
static const double exact[] = {20, 60, 20, 40, 200};
static double model[5];
static const double K_D = 100;

static void begin(void)
{
    const double start[] = {50, 175, 50, 80, 400};
    memcpy(model, start, sizeof start);
}

static void nominal(double t, double *q, double *v, double *a)
{
    static const double w[] = {1, 1.5, 1.2}, u[] = {3, 3.5, 2.5};
    for (int i = 0; i < C; i++) {
        double cw = cos(w[i] * t), cu = cos(u[i] * t);
        q[i] = 0.4 * (1 - cw) + 0.2 * (1 - cu);
        v[i] = 0.4 * w[i] * sin(w[i] * t) + 0.2 * u[i] * sin(u[i] * t);
        a[i] = 0.4 * w[i] * w[i] * cw + 0.2 * u[i] * u[i] * cu;
    }
}

static double relax(double n, double e, double d, double i) { return PD(n, e, d); }
static double weight(int i) { return 1; }
static double force(double t) { return 0; }

static void deform(const double *r, const double *h, double *out)
{
    double size = norm(h, C), b = size >= 1e-12 ? sigma(1e-8 * size) : 0;
    for (int i = 0; i < C; i++)
        out[i] = (1 + b) * r[i] + (size >= 1e-12 ? b * -1e7 * h[i] / size : 0);
}

static void effort(const double *q, const double *v, const double *r, const double *s, double *out)
{
    const double *c = model;
    double cos_ = cos(q[0]), sin_ = sin(q[0]);
    out[0] = c[1] * r[0] + c[2] * r[1] + c[0] * cos_ * r[2] - c[4] * sin_ + K_D * s[0];
    out[1] = c[2] * (r[0] + r[1]) + K_D * s[1];
    out[2] = c[0] * (cos_ * r[0] - sin_ * v[0] * (v[0] + s[0])) + c[3] * r[2] + K_D * s[2];
}

static void response(const double *q, const double *v, const double *Q, double *out)
{
    cart_response(exact, q, v, Q, out);
}

#include "loop.h"
static void tune(Memory *m, long k, const double *y, const double *d, double *out)
{
    if (k) {
        double cos_ = cos(m->last_q[0]), sin_ = sin(m->last_q[0]), v = m->last_v[0];
        double z[3][5] = {{cos_ * y[2], y[0], y[1], 0, -sin_},
                          {0, 0, y[0] + y[1], 0, 0},
                          {cos_ * y[0] - sin_ * v * v, 0, 0, y[2], 0}};
        double known[3], square[3];
        for (int i = 0; i < 3; i++) {
            double total = 0;
            for (int j = 0; j < 5; j++)
                total += z[i][j] * model[j];
            known[i] = m->last_effort[i] - total;
        }
        for (int i = 0; i < 3; i++) {
            for (int l = 0; l < i; l++) {
                double product = 0;
                for (int j = 0; j < 5; j++)
                    product += z[i][j] * z[l][j];
                double f = product / (square[l] + 1);
                for (int j = 0; j < 5; j++)
                    z[i][j] -= f * z[l][j];
                known[i] -= f * known[l];
            }
            square[i] = 0;
            for (int j = 0; j < 5; j++)
                square[i] += z[i][j] * z[i][j];
        }
        for (int j = 0; j < 5; j++) {
            double rate = 0;
            for (int i = 0; i < 3; i++)
                rate += known[i] * z[i][j] / (square[i] + 1);
            model[j] += DT * rate;
        }
    }
    memcpy(out, model, sizeof model);
}
