! The friction of friction.c, as Fortran writes it.
subroutine bristle(par, v, z, rate, by_v, by_z)
  implicit none
  double precision, intent(in) :: par(*)
  double precision, intent(out) :: v, z, rate, by_v, by_z
  double precision :: drop, g, g_by_v
  integer :: at(3), diff(1)
  logical :: error
  character(2), parameter :: velocity(3) = (/ 'VX', 'VY', 'VZ' /)
  at = (/ nint(par(2)), nint(par(3)), nint(par(3)) /)
  diff(1) = nint(par(4))
  call sysfnc(velocity(nint(par(1))), at, 3, v, error)
  call errmes(error, 'the velocity is not there', 0, 'STOP')
  call sysfnc('DIF', diff, 1, z, error)
  drop = (par(9) - par(8)) * exp(-(v / par(10))**2)
  g = par(8) + drop
  g_by_v = -2 * v / par(10)**2 * drop
  rate = v - par(5) * abs(v) / g * z
  by_v = 1 - par(5) * z * (sign(1d0, v) / g - abs(v) * g_by_v / g**2)
  by_z = -par(5) * abs(v) / g
end subroutine

subroutine give(par, by_v, by_z)
  implicit none
  double precision, intent(in) :: par(*), by_v, by_z
  integer :: at(3), diff(1)
  logical :: error
  character(2), parameter :: velocity(3) = (/ 'VX', 'VY', 'VZ' /)
  double precision :: partial(1)
  at = (/ nint(par(2)), nint(par(3)), nint(par(3)) /)
  diff(1) = nint(par(4))
  partial(1) = by_v
  call syspar(velocity(nint(par(1))), at, 3, partial, 1, error)
  partial(1) = by_z
  call syspar('DIF', diff, 1, partial, 1, error)
end subroutine

subroutine difsub(id, time, par, npar, dflag, iflag, value)
  implicit none
  integer, intent(in) :: id, npar
  double precision, intent(in) :: time, par(*)
  logical, intent(in) :: dflag, iflag
  double precision, intent(out) :: value
  double precision :: v, z, by_v, by_z
  call bristle(par, v, z, value, by_v, by_z)
  if (dflag) call give(par, by_v, by_z)
end subroutine

subroutine sfosub(id, time, par, npar, dflag, iflag, value)
  implicit none
  integer, intent(in) :: id, npar
  double precision, intent(in) :: time, par(*)
  logical, intent(in) :: dflag, iflag
  double precision, intent(out) :: value
  double precision :: v, z, rate, by_v, by_z
  call bristle(par, v, z, rate, by_v, by_z)
  value = -(par(5) * z + par(6) * rate + par(7) * v)
  if (dflag) call give(par, -(par(6) * by_v + par(7)), -(par(5) + par(6) * by_z))
end subroutine

! A SPLINE par(1) at DX of (par(2), par(3)), with its derivative; nothing where the text of STRING/1 is not "against".
subroutine of_a_spline(id, time, par, npar, dflag, iflag, value)
  implicit none
  integer, intent(in) :: id, npar
  double precision, intent(in) :: time, par(*)
  logical, intent(in) :: dflag, iflag
  double precision, intent(out) :: value
  double precision :: x, y(3), point(3), partial(1)
  integer :: at(3), count
  logical :: error
  character(12) :: text
  at = (/ nint(par(2)), nint(par(3)), nint(par(3)) /)
  call sysfnc('DX', at, 3, x, error)
  call gtstrg(1, text, count, error)
  call gtcurv(1, 0d0, 0, point, error)
  call akispl(x, 0d0, nint(par(1)), 0, y, error)
  call errmes(error, 'there is no such spline', 0, 'STOP')
  value = 0
  if (text /= 'against') return
  value = -y(1) + point(3)
  call akispl(x, 0d0, nint(par(1)), 1, y, error)
  partial(1) = -y(1)
  if (dflag) call syspar('DX', at, 3, partial, 1, error)
end subroutine
