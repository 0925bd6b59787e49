"""Check somebody's workbook of the report's sheet: by what its formulas do, not by their names.

How a workbook becomes six numbers:

1. `workbook` reads it and evaluates every formula (`spreadsheets.evaluate`). `repair` finds
   references that lack their $, and goes on with the formulas that were meant. `delimited` reads
   rows that a program wrote as text.
2. `table` finds tables by their values alone: from row to row the depth grows by the velocity times
   a constant, and the velocity falls by the deceleration times the same constant.
3. `fit` probes one row that has the usual formulas: it gives the row depths and velocities that are
   independent of each other, and sees to what each column responds, and how. `rows` fits a table
   without formulas to its numbers; what their digits admit are the errors of the six (`six`).
   If most rows do not follow, it is another method or model (`model`):

       x += c w    a = (G u^2 + H) (D x - x^2), constant beyond D/2    v -= e a    from V on

   or a named way in which a column differs from that.

How six numbers become a verdict:

4. `responses` makes each cell and each typed number that the row rests on one percent larger and
   fits again. The exponents say what it is (`roles`): G^1 is the target's density, H^1 its
   resistance, G^-1 H^-1 the mass, D^1 the radius, c^1 e^1 the step. `labels` and `words` only tell
   what responds alike, and name things. `idle` finds the table of numbers that no table reads.
5. `units`: D = 2R, 2GM/pi = rho_t, HM/pi = R_t, M = 4/3 pi R^3 rho_p, R_t = beta Y_t, c = e = dt
   have to hold. A power of ten is a unit: the one statement is found that mends all. Another ratio
   is a slip: it is looked for where the equation is written (`judge`, `constants`).
6. If neither formulas nor inputs are the report's, it is another model and not judged (`model`).
7. `cells` compares each cell that has not the usual formula of its column with that formula, in
   its own row: in value, in response to the row, in response to the inputs. So faults do not
   cascade. `ends` judges the first row, and the last by running the scheme with the inputs that
   were meant (`taken`); `excerpt` a few rows typed off the report; `results` what is shown beside
   the table; `stale` stored values.
   `solved` says which inputs that only rows show are not the report's.
8. `show` says it: the verdict, the first fault in order of calculation, what was taken for what.

`diff`, with `matching`, `layout`, `references`, `following` and `diff_show`, compares two workbooks
of any content and shares only `difference` and `shown` with the above.
"""
