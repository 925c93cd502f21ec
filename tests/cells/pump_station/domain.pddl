; Pumps bring water from a sump to towers. A pump serves some towers, at a price: the stand-by pump costs more, so that
; plans use it only where nothing else is left. Levels are in percent of a tower, of which 4 are one of the sump.
(define (domain pump-station)
  (:requirements :typing :numeric-fluents)
  (:types pump tower amount - object)
  (:predicates
    (serves ?p - pump ?t - tower))
  (:functions
    (level ?t - tower)                     ; percent
    (highest ?t - tower)
    (sump)                                 ; percent
    (lowest)
    (percent ?a - amount)
    (price ?p - pump)                      ; for each percent
    (energy))

  (:action lift
    :parameters (?p - pump ?t - tower ?a - amount)
    :precondition (and (serves ?p ?t)
                       (<= (+ (level ?t) (percent ?a)) (highest ?t))
                       (>= (- (sump) (* 0.25 (percent ?a))) (lowest)))
    :effect (and (increase (level ?t) (percent ?a))
                 (decrease (sump) (* 0.25 (percent ?a)))
                 (increase (energy) (* (price ?p) (percent ?a))))))
