/* The control cycle in plain C: laws and constants are those of the file that includes this one.
 *
 * It defines N, C, TUNED (columns of the tuning message, 0: no tuner), DELAY, DT, CYCLE [ns], LAM,
 * WHERE, START, and nominal, relax, deform, effort, force, response, tune. */
#include <math.h>
#include <string.h>

#ifdef NOTHING_KEPT /* all cycles in the same row */
#define ROW(k) 0
#else
#define ROW(k) (k)
#endif

typedef struct {
    double last_q[N], last_v[N], last_effort[N], last_r[N]; /* of the cycle before */
    double p, seen_r[N], seen_step[N];                      /* precursor observer */
} Memory;

static void tune(Memory *m, long k, const double *response, const double *desired, double *out);

static void observe(Memory *m)
{
    double product = 0, now = 0, before = 0;
    for (int i = 0; i < N; i++) {
        double step = m->last_r[i] - m->seen_r[i], last = m->seen_step[i];
        m->seen_r[i] = m->last_r[i];
        m->seen_step[i] = step;
        if (!isnan(step) && !isnan(last)) {
            product += step * last;
            now += step * step;
            before += last * last;
        }
    }
    double size = sqrt(now) * sqrt(before);
    if (size > 0)
        m->p = 0.98 * m->p + (1 - 0.98) * (product / size);
}

/* rows: the vectors of the messages in the order of the cycle, a row a cycle. Returns the cycle
 * at which it ended. */
long run(long cycles, double **rows)
{
    static double past_r[DELAY][N], past_y[DELAY][N];
    double q[N], v[N], Q[N], integral[C], last_e[C], last_v[N];
    Memory m;
    memset(&m, 0, sizeof m);
    memset(Q, 0, sizeof Q);
    memset(integral, 0, sizeof integral);
    memset(last_e, 0, sizeof last_e);
    begin();
    for (int d = 0; d < DELAY; d++)
        for (int i = 0; i < N; i++)
            past_r[d][i] = past_y[d][i] = NAN;
    for (int i = 0; i < N; i++) {
        q[i] = START[i];
        v[i] = 0;
    }
    for (long k = 0; k < cycles; k++) {
        double t = k * (double)CYCLE / 1e9, elapsed = k ? DT : 0;
        double *js_q = rows[0] + ROW(k) * N, *js_v = rows[1] + ROW(k) * N, *js_Q = rows[2] + ROW(k) * N;
        double *se_q = rows[3] + ROW(k) * N, *se_v = rows[4] + ROW(k) * N, *se_y = rows[5] + ROW(k) * N;
        double *se_r = rows[6] + ROW(k) * N;
        double *d_q = rows[7] + ROW(k) * C, *d_v = rows[8] + ROW(k) * C, *d_y = rows[9] + ROW(k) * C;
        double *d_s = rows[10] + ROW(k) * C, *out_r = rows[12] + ROW(k) * N, *out_Q = rows[13] + ROW(k) * N;
        double s[N], r[C], h[C], G[C], acting[N], a[N];
        for (int i = 0; i < N; i++) {
            js_q[i] = se_q[i] = q[i];
            js_v[i] = se_v[i] = v[i];
            js_Q[i] = Q[i];
            se_y[i] = k ? (v[i] - last_v[i]) / DT : NAN;
            se_r[i] = NAN;
            last_v[i] = v[i];
            s[i] = 0;
            out_r[i] = NAN;
        }
        nominal(t, d_q, d_v, d_y);
        for (int i = 0; i < C; i++) {
            int at = WHERE[i];
            integral[i] += elapsed * last_e[i];
            double e = d_q[i] - q[at], e_dot = d_v[i] - v[at];
            d_s[i] = e_dot + 2 * LAM * e + LAM * LAM * integral[i];
            d_y[i] = relax(d_y[i], e, e_dot, integral[i]);
            last_e[i] = e;
            s[at] = d_s[i];
        }
        if (TUNED) {
            if (k)
                observe(&m);
            tune(&m, k, se_y, d_y, rows[11] + ROW(k) * TUNED);
            rows[11][ROW(k) * TUNED + TUNED - 2] = m.p;
            rows[11][ROW(k) * TUNED + TUNED - 1] = 1;
        }
        int now = k % DELAY, then = (k + 1) % DELAY;
        for (int i = 0; i < N; i++)
            past_y[now][i] = se_y[i];
        for (int i = 0; i < C; i++) {
            int at = WHERE[i];
            double before = past_r[now][at];
            r[i] = isnan(before) ? d_y[i] : before;
            h[i] = isnan(before) ? 0 : weight(i) * (past_y[then][at] - d_y[i]);
        }
        deform(r, h, G);
        for (int i = 0; i < C; i++)
            out_r[WHERE[i]] = isnan(past_r[now][WHERE[i]]) ? d_y[i] : G[i];
        for (int i = 0; i < N; i++)
            past_r[now][i] = out_r[i];
        effort(q, v, out_r, s, out_Q);
        for (int i = 0; i < N; i++) {
            m.last_q[i] = q[i];
            m.last_v[i] = v[i];
            m.last_effort[i] = Q[i] = out_Q[i];
            m.last_r[i] = out_r[i];
            acting[i] = Q[i];
        }
        acting[0] += force(t);
        response(q, v, acting, a);
        for (int i = 0; i < N; i++) {
            if (!(fabs(a[i]) <= 1e9))
                return k;
            q[i] += DT * v[i];
            v[i] += DT * a[i];
        }
    }
    return cycles;
}
