/* TORA (thesis, section 3.2.2): SGFPT, no tuner. */
#define N 3
#define C 2
#define TUNED 0
#define DELAY 1
#define DT 0.001
#define CYCLE 1000000
#define LAM 6.0
#include "parts.h"

static const int WHERE[] = {2, 1};
static const double START[] = {0, 0, 0};
static const double exact[] = {40, 100, 20, 50, 20.0 * 9.81 * 2};
static const double model[] = {20, 45, 5, 30, 10.0 * 9.81 * 2};
static double attractive, repulsive;
static double piece[8][4];

/* pieces of the periodic cubic spline through the knots, from its second derivatives */
static void begin(void)
{
    const double y[] = {0, .7, 1, .7, 0, -.7, -1, -.7}, h = 0.5;
    double M[8] = {0};
    for (int sweep = 0; sweep < 200; sweep++)
        for (int i = 0; i < 8; i++) {
            int l = (i + 7) % 8, r = (i + 1) % 8;
            M[i] = (6 * (y[r] - 2 * y[i] + y[l]) / (h * h) - M[l] - M[r]) / 4;
        }
    for (int i = 0; i < 8; i++) {
        int r = (i + 1) % 8;
        piece[i][0] = y[i];
        piece[i][1] = (y[r] - y[i]) / h - h * (2 * M[i] + M[r]) / 6;
        piece[i][2] = M[i] / 2;
        piece[i][3] = (M[r] - M[i]) / (6 * h);
    }
    double half = 0.5 * acosh(2 * sinh(0.6) / 0.5 - cosh(0.6));
    attractive = 0.3 + half;
    repulsive = 0.3 - half;
}

static void nominal(double t, double *q, double *v, double *a)
{
    const double scale[] = {0.3, 0.5};
    for (int i = 0; i < C; i++) {
        double phase = fmod(t, 4.0);
        int at = (int)(phase / 0.5);
        at = at > 7 ? 7 : at;
        double s = phase - at * 0.5, *c = piece[at];
        q[i] = scale[i] * (c[0] + s * (c[1] + s * (c[2] + s * c[3])));
        v[i] = scale[i] * (c[1] + s * (2 * c[2] + s * 3 * c[3]));
        a[i] = scale[i] * (2 * c[2] + s * 6 * c[3]);
    }
}

static double relax(double n, double e, double d, double i) { return PID(n, e, d, i); }
static double weight(int i) { return 1; }
static double force(double t) { return 0; }

static void deform(const double *r, const double *h, double *out)
{
    double size = norm(h, C), step = 0;
    if (size > 1e-12) {
        double x = fmax(-0.1 * size + attractive, repulsive);
        step = (atanh(tanh(x) - 0.5) + 0.6 - attractive) / size;
    }
    for (int i = 0; i < C; i++)
        out[i] = r[i] + step * h[i];
}

static void effort(const double *q, const double *v, const double *r, const double *s, double *out)
{
    const double *c = model;
    double cos_ = cos(q[0]), sin_ = sin(q[0]);
    double coupling = c[0] * cos_, centrifugal = sin_ / cos_ * v[0] * v[0];
    out[0] = (coupling - c[1] * c[3] / coupling) * r[2] + c[2] * r[1] + c[1] * centrifugal
             - c[4] * sin_;
    out[1] = c[2] * (r[1] - c[3] / coupling * r[2] + centrifugal);
    out[2] = 0;
}

static void response(const double *q, const double *v, const double *Q, double *out)
{
    cart_response(exact, q, v, Q, out);
}

#include "loop.h"
static void tune(Memory *m, long k, const double *y, const double *d, double *out) {}
