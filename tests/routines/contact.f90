! The laws of contact.c, as Fortran writes them.
subroutine cnfsub(id, time, par, npar, loci, ni, locj, nj, gap, gapdot, gapdotdot, area, dflag, iflag, value)
  implicit none
  integer, intent(in) :: id, npar
  double precision, intent(in) :: time, par(*), loci(3), ni(3), locj(3), nj(3), gap, gapdot, gapdotdot, area
  logical, intent(in) :: dflag, iflag
  double precision, intent(out) :: value(3)
  logical :: error
  value = 0
  call impact(gap, gapdot, 0d0, par(1), par(2), par(3), par(4), 0, value, error)
  call errmes(error, 'no impact', id, 'STOP')
end subroutine

subroutine cffsub(id, time, par, npar, loci, locj, x, xdot, nforce, area, dflag, iflag, value)
  implicit none
  integer, intent(in) :: id, npar
  double precision, intent(in) :: time, par(*), loci(3), locj(3), x(3), xdot(3), nforce, area
  logical, intent(in) :: dflag, iflag
  double precision, intent(out) :: value(3)
  double precision :: sign, size
  logical :: error
  call step(xdot(1), -par(3), -1d0, par(3), 1d0, 0, sign, error)
  call step(xdot(1), par(3), par(1), par(4), par(2), 0, size, error)
  value = (/ -nforce * sign * size, 0d0, -par(5) * xdot(3) /)
end subroutine
