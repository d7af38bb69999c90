/* The paper's scheme over lanes in C, for gcc -O3 -march=native -ffast-math: its libmvec has a vectorised pow.
   y: rows x, v, xi, eta, growth of n lanes (n a multiple of LANES); cosines: cos(omega t) each half step of a period. */
#include <math.h>

#define LANES 64

static void slope(double alpha, double p, const double *mu, double c, double y[4][LANES], double k[4][LANES])
{
    for (int l = 0; l < LANES; l++) {
        double x = y[0][l], v = y[1][l], power = p == 1.0 ? 1.0 : pow(fabs(v), p - 1.0);
        k[0][l] = v;
        k[1][l] = mu[l] * c + x - x * x * x - alpha * power * v;
        k[2][l] = y[3][l];
        k[3][l] = (1.0 - 3.0 * x * x) * y[2][l] - alpha * p * power * y[3][l];
    }
}

static void use(double y[4][LANES], double h, double k[4][LANES], double next[4][LANES])
{
    for (int i = 0; i < 4; i++)
        for (int l = 0; l < LANES; l++) next[i][l] = y[i][l] + h * k[i][l];
}

static void block(double alpha, double p, const double *mu, double h, const double *cosines, int steps, int periods,
                  double *out, int n)
{
    double y[4][LANES], z[4][LANES], k[4][4][LANES];
    for (int i = 0; i < 4; i++)
        for (int l = 0; l < LANES; l++) y[i][l] = out[i * n + l];
    for (int period = 0; period < periods; period++) {
        for (int s = 0; s < steps; s++) {
            slope(alpha, p, mu, cosines[2 * s], y, k[0]);
            use(y, h / 2, k[0], z);
            slope(alpha, p, mu, cosines[2 * s + 1], z, k[1]);
            use(y, h / 2, k[1], z);
            slope(alpha, p, mu, cosines[2 * s + 1], z, k[2]);
            use(y, h, k[2], z);
            slope(alpha, p, mu, cosines[2 * s + 2], z, k[3]);
            for (int i = 0; i < 4; i++)
                for (int l = 0; l < LANES; l++)
                    y[i][l] += h / 6 * (k[0][i][l] + 2 * k[1][i][l] + 2 * k[2][i][l] + k[3][i][l]);
        }
        for (int l = 0; l < LANES; l++) {
            double length = sqrt(y[2][l] * y[2][l] + y[3][l] * y[3][l]);
            y[2][l] /= length, y[3][l] /= length, out[4 * n + l] += log(length);
        }
    }
    for (int i = 0; i < 4; i++)
        for (int l = 0; l < LANES; l++) out[i * n + l] = y[i][l];
}

void sweep(double alpha, double p, const double *mu, double h, const double *cosines, int steps, int periods,
           double *y, int n)
{
    for (int start = 0; start < n; start += LANES)
        if (p == 1.0) block(alpha, 1.0, mu + start, h, cosines, steps, periods, y + start, n);
        else block(alpha, p, mu + start, h, cosines, steps, periods, y + start, n);
}
